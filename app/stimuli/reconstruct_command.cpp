#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/stimuli/stimulus_commands.h"
#include "experiment/maps/coordinate_image_lookup.h"
#include "experiment/maps/reconstruction_file.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

namespace {

void refuse(const ReconstructOptions& options, const Animation& motion) {
    if (options.frame && *options.frame >= motion.frame_count) {
        throw InputError(fmt::format("--frame {}: the animation has frames 0 to {}", *options.frame,
                                     motion.frame_count - 1));
    }
    const auto extension = options.out.extension();
    if (extension != ".ply" && extension != ".obj")
        throw InputError(fmt::format("--out {}: end the name with .ply or .obj", options.out.string()));
    if (std::filesystem::exists(options.out) && !options.overwrite) {
        throw InputError(fmt::format("{}: is there already: give another --out, or --overwrite to replace it",
                                     options.out.string()));
    }
}

/// An object's maps in a view and all poses, be they drawn from its mesh or made by another program.
class StimulusMaps {
  public:
    StimulusMaps(const Protocol& protocol, const Stimulus& stimulus, const ContextChoice& context,
                 ProgressBar& bar)
        : poses_(poses_of(protocol)), objects_(protocol.objects.size()) {
        const auto place = static_cast<std::size_t>(stimulus.object);
        const ViewSettings& view = protocol.view_of(stimulus);
        const ObjectSettings& settings = protocol.objects[place];
        objects_[place] = load_object(settings, protocol, cache_folder());
        const Object& object = objects_[place];
        part_names_ = object.mesh->part_names;
        size_px_ = {view.width_px, view.height_px};
        if (object.has_mesh()) {
            const auto headless = make_headless_context(context);
            StimulusLibrary library(*headless, protocol, objects_, cache_folder());
            library.maps().prepare_maps(viewed(stimulus), std::ref(bar));
            maps_.emplace(library.cache().maps_of(viewed(stimulus)));
            return;
        }
        if (settings.lut.empty())
            throw InputError(fmt::format(
                "object \"{}\" has neither a mesh nor maps: nothing is known of its surface", object.id));
        std::vector<CoordinateImageFile> images;
        for (std::size_t pose = 0; pose < poses_.angles.size(); ++pose) {
            bar.update("reading maps of " + object.id, static_cast<int>(pose),
                       static_cast<int>(poses_.angles.size()));
            images.push_back(
                read_given_map(protocol, stimulus.object, first_frame_of(poses_, {static_cast<int>(pose)})));
        }
        images_.emplace(std::move(images), size_px_);
    }

    const SurfaceLookup& lookup() const {
        return maps_ ? static_cast<const SurfaceLookup&>(*maps_) : *images_;
    }
    /// Nothing without a mesh.
    const std::optional<CoordinateMaps>& maps() const { return maps_; }
    const PoseTable& poses() const { return poses_; }
    glm::ivec2 size_px() const { return size_px_; }
    const std::vector<std::string>& part_names() const { return part_names_; }

  private:
    PoseTable poses_;
    std::vector<Object> objects_;
    std::vector<std::string> part_names_;
    glm::ivec2 size_px_{0};
    std::optional<CoordinateMaps> maps_;
    std::optional<CoordinateImageLookup> images_;
};

Reconstruction reconstruct(const ReconstructOptions& options, int motion, const StimulusMaps& maps,
                           ProgressBar& bar) {
    if (options.frame && !options.points)
        return reconstruct_surface(maps.lookup(), maps.poses().pose_of(motion, {*options.frame}),
                                   maps.size_px());
    std::vector<PoseIndex> poses;
    if (options.frame) {
        poses.push_back(maps.poses().pose_of(motion, {*options.frame}));
    } else {
        for (int pose = 0; pose < maps.poses().count(); ++pose)
            poses.push_back({pose});
    }
    return reconstruct_cloud(maps.lookup(), poses, maps.size_px(), options.spacing,
                             [&](int done, int all) { bar.update("collecting points", done, all); });
}

} // namespace

int run_reconstruct(const ReconstructOptions& options) {
    const Protocol protocol = read_protocol_or_report(options.protocol);
    const Stimulus stimulus = object_called(protocol, options.stimulus);
    refuse(options, protocol.motion_of(stimulus));
    ProgressBar bar;
    const StimulusMaps maps(protocol, stimulus, options.context, bar);
    const Reconstruction made = reconstruct(options, stimulus.motion, maps, bar);
    if (made.positions.empty())
        throw InputError("the maps show nothing of the object");
    bar.update("writing " + options.out.filename().string(), 0, 1);
    if (options.out.has_parent_path())
        std::filesystem::create_directories(options.out.parent_path());
    write_reconstruction(options.out, made, maps.part_names());
    bar.finish();

    // Only a mesh tells what was not seen.
    std::optional<SeenArea> seen;
    if (maps.maps())
        seen.emplace(seen_area(*maps.maps()));
    if (options.json) {
        nlohmann::ordered_json json{{"file", options.out.string()},
                                    {"points", made.positions.size()},
                                    {"triangles", made.triangles.size()}};
        if (seen)
            json.update({{"mesh_area", seen->area},
                         {"never_seen_area", seen->never_seen},
                         {"never_seen_share", seen->share_never_seen()}});
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("{} points, {} triangles: {}\n", made.positions.size(), made.triangles.size(),
               options.out.string());
    if (seen)
        fmt::print("{:.1f} % of the mesh's area is seen in no frame of the animation\n",
                   100.0 * seen->share_never_seen());
    return 0;
}

} // namespace overt
