#include "render/stimulus/stimulus_cache.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/maps/coordinate_image_file.h"
#include "render/signal/display_light.h"
#include "render/stimulus/frame_description.h"
#include "render/stimulus/frame_key.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/observed_colours.h"

namespace overt {

StimulusCache::StimulusCache(const Protocol& protocol, std::span<const Object> objects,
                             std::filesystem::path folder)
    : protocol_(&protocol), objects_(objects), folder_(std::move(folder)),
      poses_(distinct_poses(protocol.motions.front())),
      surroundings_(hash_of_surroundings(protocol.lights.front())) {}

std::vector<Stimulus> StimulusCache::rendered_stimuli() const {
    std::vector<Stimulus> stimuli;
    for (int object = 0; object < static_cast<int>(objects_.size()); ++object) {
        for (int material = 0; material < static_cast<int>(protocol_->materials.size()); ++material) {
            if (!is_ready_made({object, material}))
                stimuli.push_back({object, material});
        }
    }
    return stimuli;
}

std::vector<Stimulus> StimulusCache::stimuli_with_surface() const {
    std::vector<Stimulus> stimuli;
    for (int object = 0; object < static_cast<int>(objects_.size()); ++object) {
        for (int material = 0; material < static_cast<int>(protocol_->materials.size()); ++material) {
            if (objects_[static_cast<std::size_t>(object)].has_mesh() || has_given_maps(object))
                stimuli.push_back({object, material});
        }
    }
    return stimuli;
}

void StimulusCache::require_mesh(const Stimulus& stimulus) const {
    const Object& object = object_of(stimulus);
    if (!object.has_mesh()) {
        throw InputError(fmt::format("{}, {}: there is neither a mesh to render nor [[frames]] to show",
                                     protocol_->objects[static_cast<std::size_t>(stimulus.object)].id,
                                     material_of(stimulus).id));
    }
}

std::vector<PoseIndex> StimulusCache::missing_frames(const Stimulus& stimulus,
                                                     const FrameQuality& quality) const {
    std::vector<PoseIndex> missing;
    const ContentHash key = frame_key(stimulus, quality);
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose) {
        if (!std::filesystem::exists(file_of("frames", key, {pose})))
            missing.push_back({pose});
    }
    return missing;
}

std::optional<FrameQuality> StimulusCache::best_quality(std::span<const Stimulus> stimuli,
                                                        BakeQuality least) const {
    std::vector<BakeQuality> levels{BakeQuality::reference, BakeQuality::standard, BakeQuality::draft,
                                    BakeQuality::preview};
    // Who asks for live frames gets live frames.
    if (least == BakeQuality::live)
        levels = {BakeQuality::live};
    const auto has_all = [&](const FrameQuality& quality) {
        return std::ranges::all_of(
            stimuli, [&](const Stimulus& stimulus) { return missing_frames(stimulus, quality).empty(); });
    };
    for (const BakeQuality level : levels) {
        const FrameQuality quality = quality_of(level, protocol_->bake);
        if (level >= least && has_all(quality))
            return quality;
    }
    return std::nullopt;
}

std::filesystem::path StimulusCache::frame_file_of(const Stimulus& stimulus, const FrameQuality& quality,
                                                   PoseIndex pose) const {
    return file_of("frames", frame_key(stimulus, quality), pose);
}

ContentHash StimulusCache::frame_key(const Stimulus& stimulus, const FrameQuality& quality) const {
    const Object& object = object_of(stimulus);
    const MaterialSettings& material = material_of(stimulus);
    if (quality.is_live())
        return live_key(object, material, surroundings_, protocol_->lights.front().exposure);
    return traced_key(object, material, surroundings_, protocol_->lights.front().exposure,
                      bake_settings(quality, protocol_->bake, material.kind), protocol_->bake.observer);
}

glm::dmat3 StimulusCache::display_from_frame(const FrameQuality& quality) const {
    if (quality.is_live())
        return display_from(PictureColours::rec709, protocol_->display);
    return protocol_->lights.front().exposure *
           display_from(rendered_colours(protocol_->bake.observer), protocol_->display);
}

void StimulusCache::store(const Stimulus& stimulus, PoseIndex pose, const FrameQuality& quality,
                          const SpectralFrame& frame) const {
    OVERT_EXPECTS(frame.is_complete);
    const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    const Degrees angle = angle_of(pose);
    const MaterialSettings& material = material_of(stimulus);
    ImageAttributes attributes = describe_stimulus(*protocol_, object_of(stimulus), material, angle);
    for (auto& attribute : describe_tracing(quality, *protocol_, material.kind))
        attributes.push_back(std::move(attribute));
    attributes.emplace_back("overt:key", frame_key(stimulus, quality));
    write_linear_exr(file, seen_by(protocol_->bake.observer, frame), attributes);
}

bool StimulusCache::has_given_maps(int object) const {
    return !protocol_->objects[static_cast<std::size_t>(object)].lut.empty();
}

std::filesystem::path StimulusCache::map_file(int object, PoseIndex pose) const {
    if (has_given_maps(object)) {
        return file_of("given_maps", hash_of_given_map(*protocol_, object, first_frame_of(poses_, pose)),
                       pose);
    }
    return file_of("maps", map_key(objects_[static_cast<std::size_t>(object)]), pose);
}

SceneView StimulusCache::scene_of_given_maps(int object) const {
    SceneView scene;
    scene.view.camera.vertical_fov.value = 0.0;
    scene.view.image_px = {protocol_->views.front().width_px, protocol_->views.front().height_px};
    const MapDescription first = read_map_description(map_file(object, {0}));
    if (first.camera)
        scene.view.camera = *first.camera;
    if (first.bounds) {
        scene.bounds = *first.bounds;
        return scene;
    }
    // Coordinates that need no box to be read: it is as large as what is seen.
    scene.bounds = {glm::dvec3(std::numeric_limits<double>::infinity()),
                    glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose) {
        for (const glm::vec4& pixel : read_coordinate_image(map_file(object, {pose})).image.pixels) {
            if (pixel.w == 0.0f)
                continue;
            scene.bounds.min = glm::min(scene.bounds.min, glm::dvec3(pixel));
            scene.bounds.max = glm::max(scene.bounds.max, glm::dvec3(pixel));
        }
    }
    return scene;
}

CoordinateMaps StimulusCache::maps_of(int object) const {
    const Object& figure = objects_[static_cast<std::size_t>(object)];
    OVERT_EXPECTS(figure.has_mesh());
    std::vector<TriangleMap> maps;
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose)
        maps.push_back(read_triangle_map(map_file(object, {pose})));
    return {figure.mesh, figure.scene, poses_.angles, std::move(maps)};
}

std::filesystem::path StimulusCache::file_of(std::string_view kind, const ContentHash& hash,
                                             PoseIndex pose) const {
    return folder_ / kind / hash.substr(0, 24) / fmt::format("{:+010.5f}deg.exr", angle_of(pose).value);
}

} // namespace overt
