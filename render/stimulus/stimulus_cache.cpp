#include "render/stimulus/stimulus_cache.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
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
        if (!is_frame(file_of("frames", key, pose.object), {key, pose.object}, quality))
            missing.push_back(pose);
    }
    return missing;
}

FrameIdentity StimulusCache::identity_of(const Stimulus& stimulus, const FrameQuality& quality,
                                         const Pose& pose) const {
    return {picture_key(stimulus, quality, pose.light), pose.object};
}

bool StimulusCache::is_frame(const std::filesystem::path& file, const FrameIdentity& identity,
                             const FrameQuality& quality) const {
    // Live frames that do not say all of themselves are drawn again in no time.
    return std::filesystem::exists(file) && !why_no_frame(file, identity, quality.is_live());
}

bool StimulusCache::has_frame(const Stimulus& stimulus, const FrameQuality& quality, const Pose& pose) const {
    return is_frame(frame_file_of(stimulus, quality, pose), identity_of(stimulus, quality, pose), quality);
}

std::vector<std::string> StimulusCache::unsound_frames(std::span<const Stimulus> stimuli,
                                                       const FrameQuality& quality) const {
    std::set<std::filesystem::path> files;
    std::vector<std::string> sentences;
    for (const Stimulus& stimulus : stimuli)
        for (const Pose& pose : pictures_of(stimulus)) {
            const auto [file, is_new] = files.insert(frame_file_of(stimulus, quality, pose));
            if (!is_new || !std::filesystem::exists(*file))
                continue;
            if (const auto why = why_no_frame(*file, identity_of(stimulus, quality, pose), false))
                sentences.push_back(fmt::format("{} {}", file->string(), *why));
        }
    return sentences;
}

void StimulusCache::read_frame(const Stimulus& stimulus, const FrameQuality& quality, const Pose& pose,
                               LinearImage& into) const {
    read_cached_frame(frame_file_of(stimulus, quality, pose), identity_of(stimulus, quality, pose), into);
}

ContentHash StimulusCache::pixels_hash(const Stimulus& stimulus, const FrameQuality& quality) const {
    const std::span<const Pose> pictures = pictures_of(stimulus);
    std::vector<ContentHash> hashes(pictures.size());
    std::atomic<bool> are_all_there = true;
    parallel_for(static_cast<int>(pictures.size()), [&](int i) {
        const Pose& pose = pictures[static_cast<std::size_t>(i)];
        const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
        if (!std::filesystem::exists(file))
            are_all_there = false;
        if (are_all_there)
            hashes[static_cast<std::size_t>(i)] = pixels_hash_of(file, identity_of(stimulus, quality, pose));
    });
    if (!are_all_there)
        return {};
    ContentHasher hasher;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        add_object(hasher, pictures[i].object);
        hasher.add(pictures[i].light.value).add(std::string_view(hashes[i]));
    }
    return hasher.finish();
}

std::string StimulusCache::renderer_of(const Stimulus& stimulus, const FrameQuality& quality) const {
    std::set<std::string> renderers;
    for (const Pose& pose : pictures_of(stimulus)) {
        const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
        if (quality.is_live() && std::filesystem::exists(file))
            renderers.insert(renderer_of_frame(file));
    }
    return fmt::format("{}", fmt::join(renderers, " and "));
}

FrameCount StimulusCache::count_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality) const {
    std::set<std::filesystem::path> files;
    FrameCount count;
    for (const Stimulus& stimulus : stimuli) {
        for (const Pose& pose : pictures_of(stimulus)) {
            const auto [file, is_new] = files.insert(frame_file_of(stimulus, quality, pose));
            count.all += is_new;
            count.missing += is_new && !is_frame(*file, identity_of(stimulus, quality, pose), quality);
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

void StimulusCache::store_live(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                               const LinearImage& image, const std::string& renderer) const {
    ImageAttributes attributes = describe_stimulus(*protocol_, objects_, stimulus, pose);
    attributes.emplace_back("overt:renderer", "OpenGL");
    attributes.emplace_back("overt:gl_renderer", renderer);
    write_cached_frame(frame_file_of(stimulus, quality, pose), image, identity_of(stimulus, quality, pose),
                       std::move(attributes));
}

std::vector<Stimulus> StimulusCache::parts_of(const Stimulus& stimulus) const {
    std::vector<Stimulus> parts;
    for (const auto& [id, share] : protocol_->light_of(stimulus).sum) {
        const auto found = std::ranges::find(protocol_->lights, id, &LightSettings::id);
        OVERT_EXPECTS(found != protocol_->lights.end());
        Stimulus& part = parts.emplace_back(stimulus);
        part.light = static_cast<int>(found - protocol_->lights.begin());
    }
    return parts;
}

bool StimulusCache::can_add_up(const Stimulus& stimulus, const Pose& pose,
                               const FrameQuality& quality) const {
    return std::ranges::all_of(parts_of(stimulus),
                               [&](const Stimulus& part) { return has_frame(part, quality, pose); });
}

void StimulusCache::add_up(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality) const {
    const std::vector<Stimulus> parts = parts_of(stimulus);
    LinearImage sum, part;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        read_frame(parts[i], quality, pose, part);
        if (i == 0) {
            sum = part; // with its alpha, which is that of all
            for (glm::vec4& pixel : sum.pixels)
                pixel = glm::vec4(0.0f, 0.0f, 0.0f, pixel.a);
        }
        const auto share = static_cast<float>(protocol_->light_of(stimulus).sum[i].second);
        for (std::size_t pixel = 0; pixel < sum.pixels.size(); ++pixel)
            sum.pixels[pixel] += glm::vec4(share * glm::vec3(part.pixels[pixel]), 0.0f);
    }
    const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    ImageAttributes attributes = describe_stimulus(*protocol_, objects_, stimulus, pose);
    for (auto& attribute : describe_tracing(quality, *protocol_, material_of(stimulus).kind))
        attributes.push_back(std::move(attribute));
    write_cached_frame(file, sum, identity_of(stimulus, quality, pose), std::move(attributes));
}

void StimulusCache::store(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                          const SpectralFrame& frame) const {
    OVERT_EXPECTS(frame.is_complete);
    const std::filesystem::path file = frame_file_of(stimulus, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    ImageAttributes attributes = describe_stimulus(*protocol_, objects_, stimulus, pose);
    for (auto& attribute : describe_tracing(quality, *protocol_, material_of(stimulus).kind))
        attributes.push_back(std::move(attribute));
    write_cached_frame(file, seen_by(protocol_->bake.observer, frame), identity_of(stimulus, quality, pose),
                       std::move(attributes));
}

bool StimulusCache::has_given_maps(int object) const {
    return !protocol_->objects[static_cast<std::size_t>(object)].lut.empty();
}

std::filesystem::path StimulusCache::map_file(const ViewedObject& viewed, PoseIndex pose) const {
    const ObjectPose& object = poses_.object_of(pose);
    if (has_given_maps(viewed.object))
        return file_of("given_maps",
                       hash_of_given_map(*protocol_, viewed.object, first_frame_of(poses_, pose)), object);
    return file_of("maps", map_key(objects_[static_cast<std::size_t>(viewed.object)], viewed.view), object);
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

bool StimulusCache::has_map(const ViewedObject& viewed, PoseIndex pose) const {
    const std::filesystem::path file = map_file(viewed, pose);
    return std::filesystem::exists(file) &&
           is_map_of(file, objects_[static_cast<std::size_t>(viewed.object)].mesh_hash,
                     poses_.object_of(pose).angle);
}

TriangleMap StimulusCache::read_map(const ViewedObject& viewed, PoseIndex pose) const {
    const std::filesystem::path file = map_file(viewed, pose);
    if (std::filesystem::exists(file) && !has_map(viewed, pose))
        throw InputError(
            fmt::format("{}: this file of the cache is not the map that its name says, or not whole: "
                        "remove it, so that it is made anew",
                        file.string()));
    return read_triangle_map(file);
}

CoordinateMaps StimulusCache::maps_of(const ViewedObject& viewed) const {
    const Object& figure = objects_[static_cast<std::size_t>(viewed.object)];
    OVERT_EXPECTS(figure.has_mesh());
    std::vector<TriangleMap> maps;
    for (int pose = 0; pose < poses_.count(); ++pose)
        maps.push_back(read_map(viewed, {pose}));
    return {figure.mesh, figure.scene(viewed.view), poses_.angles, std::move(maps)};
}

std::filesystem::path StimulusCache::file_of(std::string_view kind, const ContentHash& hash,
                                             const ObjectPose& object) const {
    std::string name = fmt::format("{:+010.5f}deg", object.angle.value);
    if (!object.is_turn()) {
        ContentHasher hasher;
        add_object(hasher, object);
        name += fmt::format("-{}", hasher.finish().substr(0, 16));
    }
    return folder_ / kind / hash.substr(0, 24) / (name + ".exr");
}

} // namespace overt
