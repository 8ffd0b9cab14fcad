#include "render/stimulus/stimulus_cache.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/maps/coordinate_image_file.h"
#include "render/signal/display_light.h"
#include "render/stimulus/frame_description.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/observed_colours.h"

namespace overt {

StimulusCache::StimulusCache(const Protocol& protocol, std::span<const Object> objects,
                             std::filesystem::path folder)
    : protocol_(&protocol), objects_(objects), folder_(std::move(folder)), poses_(poses_of(protocol)) {
    for (const Animation& motion : protocol.motions)
        motions_.push_back(pictures_of_motion(motion));
    for (const LightSettings& light : protocol.lights)
        lights_.emplace_back(light);
}

StimulusCache::Pictures StimulusCache::pictures_of_motion(const Animation& motion) {
    Pictures of{motion.pictures(), {}};
    for (int frame = 0; frame < motion.frame_count; ++frame) {
        const auto found = std::ranges::find_if(
            of.pictures, [&](const Pose& pose) { return is_same_pose(pose, motion.pose_of({frame})); });
        of.picture_of_frame.push_back(static_cast<int>(found - of.pictures.begin()));
    }
    return of;
}

std::vector<Stimulus> StimulusCache::rendered_stimuli() const {
    std::vector<Stimulus> stimuli = stimuli_in_slots(*protocol_);
    std::erase_if(stimuli, [&](const Stimulus& stimulus) { return is_ready_made(stimulus); });
    return stimuli;
}

std::vector<Stimulus> StimulusCache::stimuli_with_surface() const {
    std::vector<Stimulus> stimuli = stimuli_in_slots(*protocol_);
    std::erase_if(stimuli, [&](const Stimulus& stimulus) {
        return !object_of(stimulus).has_mesh() && !has_given_maps(stimulus.object);
    });
    return stimuli;
}

void StimulusCache::require_mesh(const Stimulus& stimulus) const {
    const Object& object = object_of(stimulus);
    if (!object.has_mesh()) {
        throw InputError(fmt::format("{}: there is neither a mesh to render nor [[frames]] to show",
                                     stimulus_name(*protocol_, stimulus)));
    }
}

std::vector<Pose> StimulusCache::missing_frames(const Stimulus& stimulus, const FrameQuality& quality) const {
    std::vector<Pose> missing;
    ContentHash key;
    std::optional<Degrees> key_of; // neighbours often share a turn of the light
    for (const Pose& pose : pictures_of(stimulus)) {
        if (key_of != pose.light) {
            key = picture_key(stimulus, quality, pose.light);
            key_of = pose.light;
        }
        if (!std::filesystem::exists(file_of("frames", key, pose.object)))
            missing.push_back(pose);
    }
    return missing;
}

FrameCount StimulusCache::count_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality) const {
    std::set<std::filesystem::path> files;
    FrameCount count;
    for (const Stimulus& stimulus : stimuli) {
        for (const Pose& pose : pictures_of(stimulus)) {
            const auto [file, is_new] = files.insert(frame_file_of(stimulus, quality, pose));
            count.all += is_new;
            count.missing += is_new && !std::filesystem::exists(*file);
        }
    }
    return count;
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
                                                   const Pose& pose) const {
    return file_of("frames", picture_key(stimulus, quality, pose.light), pose.object);
}

ContentHash StimulusCache::picture_key(const Stimulus& stimulus, const FrameQuality& quality,
                                       Degrees light_turn) const {
    const Object& object = object_of(stimulus);
    const MaterialSettings& material = material_of(stimulus);
    const Surroundings& surroundings = lights_[static_cast<std::size_t>(stimulus.light)];
    const double exposure = surroundings.light.exposure;
    if (quality.is_live())
        return live_key(object, stimulus.view, material, hash_of_surroundings(surroundings, {}), light_turn,
                        exposure);
    return traced_key(object, stimulus.view, material, hash_of_surroundings(surroundings, light_turn),
                      exposure, bake_settings(quality, protocol_->bake, material.kind),
                      protocol_->bake.observer);
}

ContentHash StimulusCache::frame_key(const Stimulus& stimulus, const FrameQuality& quality) const {
    std::vector<Degrees> turns;
    for (const Pose& pose : pictures_of(stimulus)) {
        if (turns.empty() || turns.back() != pose.light)
            turns.push_back(pose.light);
    }
    if (turns.size() == 1)
        return picture_key(stimulus, quality, turns.front());
    ContentHasher hasher;
    for (const Degrees turn : turns)
        hasher.add(std::string_view(picture_key(stimulus, quality, turn)));
    return hasher.finish();
}

glm::dmat3 StimulusCache::display_from_frame(const Stimulus& stimulus, const FrameQuality& quality) const {
    if (quality.is_live())
        return display_from(PictureColours::rec709, protocol_->display);
    return protocol_->light_of(stimulus).exposure *
           display_from(rendered_colours(protocol_->bake.observer), protocol_->display);
}

void StimulusCache::store(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                          const SpectralFrame& frame) const {
    OVERT_EXPECTS(frame.is_complete);
    const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    ImageAttributes attributes = describe_stimulus(*protocol_, objects_, stimulus, pose);
    for (auto& attribute : describe_tracing(quality, *protocol_, material_of(stimulus).kind))
        attributes.push_back(std::move(attribute));
    attributes.emplace_back("overt:key", picture_key(stimulus, quality, pose.light));
    write_linear_exr(file, seen_by(protocol_->bake.observer, frame), attributes);
}

bool StimulusCache::has_given_maps(int object) const {
    return !protocol_->objects[static_cast<std::size_t>(object)].lut.empty();
}

std::filesystem::path StimulusCache::map_file(const ViewedObject& viewed, PoseIndex pose) const {
    const Degrees turn = poses_.angle_of(pose);
    if (has_given_maps(viewed.object))
        return file_of("given_maps",
                       hash_of_given_map(*protocol_, viewed.object, first_frame_of(poses_, pose)), turn);
    return file_of("maps", map_key(objects_[static_cast<std::size_t>(viewed.object)], viewed.view), turn);
}

SceneView StimulusCache::scene_of_given_maps(const ViewedObject& viewed) const {
    const ViewSettings& view = protocol_->view_at(viewed.view);
    SceneView scene;
    scene.view.camera.vertical_fov.value = 0.0;
    scene.view.image_px = {view.width_px, view.height_px};
    const MapDescription first = read_map_description(map_file(viewed, {0}));
    if (first.camera)
        scene.view.camera = *first.camera;
    if (first.bounds) {
        scene.bounds = *first.bounds;
        return scene;
    }
    // Coordinates that need no box to be read: it is as large as what is seen.
    scene.bounds = {glm::dvec3(std::numeric_limits<double>::infinity()),
                    glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (int pose = 0; pose < poses_.count(); ++pose) {
        for (const glm::vec4& pixel : read_coordinate_image(map_file(viewed, {pose})).image.pixels) {
            if (pixel.w == 0.0f)
                continue;
            scene.bounds.min = glm::min(scene.bounds.min, glm::dvec3(pixel));
            scene.bounds.max = glm::max(scene.bounds.max, glm::dvec3(pixel));
        }
    }
    return scene;
}

CoordinateMaps StimulusCache::maps_of(const ViewedObject& viewed) const {
    const Object& figure = objects_[static_cast<std::size_t>(viewed.object)];
    OVERT_EXPECTS(figure.has_mesh());
    std::vector<TriangleMap> maps;
    for (int pose = 0; pose < poses_.count(); ++pose)
        maps.push_back(read_triangle_map(map_file(viewed, {pose})));
    return {figure.mesh, figure.scene(viewed.view), poses_.angles, std::move(maps)};
}

std::filesystem::path StimulusCache::file_of(std::string_view kind, const ContentHash& hash,
                                             Degrees turn) const {
    return folder_ / kind / hash.substr(0, 24) / fmt::format("{:+010.5f}deg.exr", turn.value);
}

} // namespace overt
