#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/stimuli/stimulus_commands.h"
#include "experiment/maps/coordinate_image_lookup.h"
#include "experiment/maps/reconstruction_file.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

namespace {

void refuse(const ReconstructOptions& options, const Protocol& protocol) {
    if (options.frame && *options.frame >= protocol.motions.front().frame_count) {
        throw InputError(fmt::format("--frame {}: the animation has frames 0 to {}", *options.frame,
                                     protocol.motions.front().frame_count - 1));
    }
    const auto extension = options.out.extension();
    if (extension != ".ply" && extension != ".obj")
        throw InputError(fmt::format("--out {}: end the name with .ply or .obj", options.out.string()));
    if (std::filesystem::exists(options.out) && !options.overwrite) {
        throw InputError(fmt::format("{}: is there already: give another --out, or --overwrite to replace it",
                                     options.out.string()));
    }
}

/// An object's maps in all poses, be they drawn from its mesh or made by another program.
class StimulusMaps {
  public:
    StimulusMaps(const Protocol& protocol, int index, const ContextChoice& context, ProgressBar& bar)
        : poses_(distinct_poses(protocol.motions.front())), objects_(protocol.objects.size()) {
        const auto place = static_cast<std::size_t>(index);
        const ObjectSettings& settings = protocol.objects[place];
        objects_[place] = load_object(settings, protocol, cache_folder());
        const Object& object = objects_[place];
        part_names_ = object.mesh.part_names;
        size_px_ = {protocol.views.front().width_px, protocol.views.front().height_px};
        if (object.has_mesh()) {
            const auto headless = make_headless_context(context);
            StimulusLibrary library(*headless, protocol, objects_, cache_folder());
            library.maps().prepare_maps(index, std::ref(bar));
            maps_.emplace(library.cache().maps_of(index));
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
                read_given_map(protocol, index, first_frame_of(poses_, {static_cast<int>(pose)})));
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

Reconstruction reconstruct(const ReconstructOptions& options, const StimulusMaps& maps, ProgressBar& bar) {
    if (options.frame && !options.points)
        return reconstruct_surface(maps.lookup(), maps.poses().pose_of({*options.frame}), maps.size_px());
    std::vector<PoseIndex> poses;
    if (options.frame) {
        poses.push_back(maps.poses().pose_of({*options.frame}));
    } else {
        for (int pose = 0; pose < static_cast<int>(maps.poses().angles.size()); ++pose)
            poses.push_back({pose});
    }
    return reconstruct_cloud(maps.lookup(), poses, maps.size_px(), options.spacing,
                             [&](int done, int all) { bar.update("collecting points", done, all); });
}

} // namespace

int run_reconstruct(const ReconstructOptions& options) {
    const Protocol protocol = read_protocol_or_report(options.protocol);
    const int index = object_called(protocol, options.stimulus);
    refuse(options, protocol);
    ProgressBar bar;
    const StimulusMaps maps(protocol, index, options.context, bar);
    const Reconstruction made = reconstruct(options, maps, bar);
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
