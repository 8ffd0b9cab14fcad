#include <future>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/figures.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/stimuli/map_figures.h"
#include "app/stimuli/stimulus_commands.h"
#include "experiment/base/counted.h"
#include "experiment/maps/coordinate_image_file.h"
#include "experiment/maps/glass_sight.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/clear_glass.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

namespace {

/// The unit of a mesh whose protocol says that it is unknown.
constexpr const char* own_unit = "that of the mesh file, times the protocol's scale";

/// The frames to write, by the distinct pose that they show: each pose is drawn once.
std::map<PoseIndex, std::vector<int>> frames_by_pose(const Animation& animation,
                                                     std::span<const PoseIndex> pose_of_frame,
                                                     std::optional<int> frame) {
    if (frame && *frame >= animation.frame_count) {
        throw InputError(
            fmt::format("--frame {}: the animation has frames 0 to {}", *frame, animation.frame_count - 1));
    }
    std::map<PoseIndex, std::vector<int>> frames;
    for (int k = 0; k < animation.frame_count; ++k) {
        if (!frame || *frame == k)
            frames[pose_of_frame[static_cast<std::size_t>(k)]].push_back(k);
    }
    return frames;
}

/// Where the maps go, and as what.
class MapFiles {
  public:
    MapFiles(const LutOptions& options, std::string object)
        : folder_(options.out.empty() ? std::filesystem::path("luts") / object : options.out),
          object_(std::move(object)), exr_(options.format != "png16"), png_(options.format != "exr") {}

    /// Throws InputError if a file of these frames is there already.
    void refuse_to_overwrite(const std::map<PoseIndex, std::vector<int>>& frames) const {
        for (const auto& [pose, numbers] : frames) {
            for (const int frame : numbers) {
                for (const std::filesystem::path& file : files_of(frame)) {
                    if (std::filesystem::exists(file)) {
                        throw InputError(fmt::format(
                            "{}: is there already: give another --out, or --overwrite to replace it",
                            file.string()));
                    }
                }
            }
        }
    }

    std::vector<std::filesystem::path> files_of(int frame) const {
        const std::filesystem::path stem = folder_ / fmt::format("{}_frame_{:04}", object_, frame);
        std::vector<std::filesystem::path> files;
        for (const auto& [wanted, extension] : {std::pair{exr_, ".exr"}, {png_, ".png"}, {png_, ".json"}}) {
            if (wanted)
                files.emplace_back(stem.string() + extension);
        }
        return files;
    }

    void write(const CoordinateImage& image, MapDescription description,
               const std::vector<int>& frames) const {
        std::filesystem::create_directories(folder_);
        for (const int frame : frames) {
            description.frame = frame;
            const std::vector<std::filesystem::path> files = files_of(frame);
            if (exr_)
                write_coordinate_exr(files.front(), image, description);
            if (png_)
                write_coordinate_png(files[exr_ ? 1 : 0], image, description);
        }
    }

    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
    std::string object_;
    bool exr_, png_;
};

MapDescription description_of(const Object& object, int view, std::string_view unit, int scale) {
    const SceneView& scene = object.scene(view);
    MapDescription description;
    description.object = object.id;
    description.unit = unit == "mm" ? unit : own_unit;
    description.bounds = scene.bounds;
    description.scale = scale;
    description.camera = scene.view.camera;
    description.size_px = scene.view.image_px;
    description.mesh_sha256 = object.mesh_hash;
    return description;
}

/// The exact maps of some poses, drawn anew.
CoordinateMaps draw_maps(StimulusLibrary& library, const Object& object, const ViewedObject& viewed,
                         const std::map<PoseIndex, std::vector<int>>& frames, ProgressBar& bar) {
    std::vector<ObjectPose> angles;
    std::vector<TriangleMap> maps;
    for (const auto& [pose, numbers] : frames) {
        bar.update("mapping " + object.id, static_cast<int>(maps.size()), static_cast<int>(frames.size()));
        angles.push_back(library.cache().poses().angles[static_cast<std::size_t>(pose.value)]);
        maps.push_back(library.maps().draw_map(viewed, pose));
        if (maps.back().covered_pixels() == 0) {
            throw InputError(
                fmt::format("object \"{}\" is nowhere in the picture at {:.3g} degrees: correct the camera "
                            "under {}",
                            object.id, angles.back().angle.value,
                            section_of_view(library.cache().protocol(), viewed.view)));
        }
    }
    return {object.mesh, object.scene(viewed.view), angles, std::move(maps)};
}

/// The index of the glass that is to be looked through; nothing if it is not. Throws InputError.
std::optional<double> glass_to_look_through(const LutOptions& options, const Protocol& protocol,
                                            const Stimulus& stimulus) {
    if (!options.through)
        return std::nullopt;
    if (options.check)
        throw InputError(
            "--check compares maps of the front with rays, and --through writes others: take one "
            "of the two");
    const MaterialSettings& material = protocol.material_of(stimulus);
    const std::optional<double> index = clear_glass_index(material);
    if (!index)
        throw InputError(fmt::format("--through: material \"{}\" is no polished glass (`kind = \"glass\"` "
                                     "without `roughness`), and through nothing else goes a line of sight: "
                                     "name one by --stimulus {}/MATERIAL",
                                     material.id, protocol.object_of(stimulus).id));
    return index;
}

/// Pixels of all maps together.
struct PixelsThrough {
    std::size_t front = 0, far = 0;
};

void print_outcome(const LutOptions& options, const std::vector<std::string>& files,
                   const BenchFigures& figures, const PixelsThrough& pixels,
                   const std::filesystem::path& folder) {
    if (options.json) {
        nlohmann::ordered_json json = to_json(figures);
        json["files"] = files;
        if (options.through)
            json["pixels"] = {{"front", pixels.front}, {"through", pixels.far}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    print_table(figures);
    if (options.through)
        fmt::print("{} of {} pixels of the object have a far side; through the others the line of sight is "
                   "reflected totally more than {} times\n",
                   pixels.far, pixels.front, most_total_reflections);
    if (!files.empty())
        fmt::print("{}: {}\n", counted(files.size(), "file"), folder.string());
}

} // namespace

int run_lut(const LutOptions& options) {
    const Protocol protocol = read_protocol_or_report(options.protocol);
    const Stimulus stimulus = object_called(protocol, options.stimulus);
    const std::optional<double> glass_index = glass_to_look_through(options, protocol, stimulus);
    const ObjectSettings& settings = protocol.object_of(stimulus);
    std::vector<Object> objects(protocol.objects.size());
    Object& object = objects[static_cast<std::size_t>(stimulus.object)];
    object = load_object(settings, protocol, cache_folder());
    if (!object.has_mesh()) {
        throw InputError(
            fmt::format("object \"{}\" has no mesh to make maps of, or to check them against", object.id));
    }

    const auto context = make_headless_context(options.context);
    StimulusLibrary library(*context, protocol, objects, cache_folder());
    const auto frames = frames_by_pose(protocol.motion_of(stimulus),
                                       library.cache().poses().frames_of(stimulus.motion), options.frame);
    const SceneView& scene = object.scenes[static_cast<std::size_t>(stimulus.view)];
    std::string name = viewed_name(protocol, viewed(stimulus), '_');
    if (glass_index)
        name += "_through_" + protocol.material_of(stimulus).id;
    const MapFiles files(options, name);
    // A check alone leaves nothing behind.
    const bool writes = !options.check || !options.out.empty();
    if (writes && !options.overwrite)
        files.refuse_to_overwrite(frames);

    ProgressBar bar;
    const CoordinateMaps maps = draw_maps(library, object, viewed(stimulus), frames, bar);
    std::optional<GlassSight> glass;
    PixelsThrough pixels;
    if (glass_index)
        glass.emplace(maps, *glass_index);
    std::optional<RayCaster> rays;
    if (options.check)
        rays.emplace(object.mesh);
    std::optional<MapCheck> check;
    std::vector<std::string> written;
    MapDescription description =
        description_of(object, stimulus.view, unit_of_lengths(settings), options.scale);
    description.glass_index = glass_index;
    std::future<void> writing; // one map is compressed and written while the next is worked out
    int drawn = 0;
    for (const auto& [pose, numbers] : frames) {
        bar.update(fmt::format("{} {}", writes ? "writing maps of" : "checking", object.id), drawn,
                   static_cast<int>(frames.size()));
        // A file knows of turns about the vertical alone.
        const ObjectPose& placed = library.cache().poses().object_of(pose);
        description.angle = placed.is_turn() ? std::optional(placed.angle) : std::nullopt;
        const PoseIndex of_maps{drawn++};
        CoordinateImage image = coordinate_image(maps, of_maps, scene.view.image_px);
        if (glass) {
            pixels.front += image.covered_pixels();
            image = glass->image(of_maps);
            pixels.far += image.covered_pixels();
        }
        if (rays) {
            const MapCheck one = check_map(image, *rays, scene, placed, options.scale);
            check = check ? worst_of(*check, one) : one;
        }
        if (!writes)
            continue;
        if (writing.valid())
            writing.get();
        for (const int frame : numbers) {
            for (const std::filesystem::path& file : files.files_of(frame))
                written.push_back(file.string());
        }
        writing = std::async(std::launch::async,
                             [&files, image = std::move(image), description, &of_image = numbers] {
                                 files.write(image, description, of_image);
                             });
    }
    if (writing.valid())
        writing.get();
    bar.update(fmt::format("{} {}", writes ? "writing maps of" : "checking", object.id), drawn, drawn);
    bar.finish();
    const BenchFigures figures = check ? figures_of(*check, scene.view.image_px, object.id) : BenchFigures{};
    print_outcome(options, written, figures, pixels, files.folder());
    return all_hold(figures) ? 0 : 1;
}

} // namespace overt
