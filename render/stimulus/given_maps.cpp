#include "render/stimulus/given_maps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/stimulus/object.h"

namespace overt {

namespace {

/// Changes whenever the same files would be read differently.
constexpr int given_map_version = 1;

/// Angles are written with few digits by some programs.
constexpr double same_angle_deg = 1e-3;

MapDescription known_of(const ObjectSettings& settings) {
    MapDescription known;
    known.scale = settings.lut_scale;
    if (settings.lut_min && settings.lut_max)
        known.bounds = Bounds{*settings.lut_min, *settings.lut_max};
    return known;
}

/// Where the protocol says that the camera stands; nothing if it leaves that open.
std::optional<Camera> camera_of(const Protocol& protocol, const std::optional<Bounds>& bounds) {
    const ViewSettings& view = protocol.views.front();
    if (!view.camera_position || !view.vertical_fov_deg || !(view.camera_target || bounds))
        return std::nullopt;
    return Camera{*view.camera_position,
                  view.camera_target ? *view.camera_target : bounds->centre(),
                  {*view.vertical_fov_deg}};
}

/// Parts as map_part_names() has them.
void label_areas(CoordinateImage& image, std::span<const PartRegion> areas) {
    image.parts.assign(image.pixels.size(), PartIndex{0});
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (image.pixels[i].w == 0.0f)
            continue;
        unsigned part = 0;
        for (std::size_t area = 0; area < areas.size(); ++area)
            part |= areas[area].contains(glm::dvec3(image.pixels[i])) ? 1u << area : 0u;
        image.parts[i] = static_cast<PartIndex>(part);
    }
}

} // namespace

AnimationFrameIndex first_frame_of(const PoseTable& poses, PoseIndex pose) {
    const std::span<const PoseIndex> frames = poses.frames_of(0);
    const auto found = std::ranges::find(frames, pose);
    OVERT_EXPECTS(found != frames.end());
    return {static_cast<int>(found - frames.begin())};
}

CoordinateImageFile read_given_map(const Protocol& protocol, int object, AnimationFrameIndex frame) {
    const ObjectSettings& settings = protocol.objects[static_cast<std::size_t>(object)];
    const std::filesystem::path file = lut_file(settings, frame);
    CoordinateImageFile map = read_coordinate_image(file, known_of(settings));
    const glm::ivec2 wanted(protocol.views.front().width_px, protocol.views.front().height_px);
    if (map.image.size_px != wanted) {
        throw InputError(
            fmt::format("{}: is a map of {} x {} pixels, but [view] asks for {} x {}: a map has the size of "
                        "its frame, and is never resized",
                        file.string(), map.image.size_px.x, map.image.size_px.y, wanted.x, wanted.y));
    }
    const Degrees angle = protocol.motions.front().angle_of(frame);
    MapDescription& description = map.description;
    if (description.angle && std::abs(description.angle->value - angle.value) > same_angle_deg) {
        throw InputError(fmt::format("{}: was made of the object turned by {} degrees, but frame {} shows it "
                                     "turned by {:.6g}: correct [animation], or lut_first_number",
                                     file.string(), description.angle->value, frame.value, angle.value));
    }
    description.angle = angle;
    description.object = settings.id;
    description.frame = frame.value;
    if (!description.camera)
        description.camera = camera_of(protocol, description.bounds);
    if (!settings.areas.empty())
        label_areas(map.image, area_regions(settings));
    return map;
}

ContentHash hash_of_given_map(const Protocol& protocol, int object, AnimationFrameIndex frame) {
    const ObjectSettings& settings = protocol.objects[static_cast<std::size_t>(object)];
    const std::filesystem::path file = lut_file(settings, frame);
    const std::filesystem::path sidecar = sidecar_of(file);
    ContentHasher hasher;
    hasher.add(given_map_version).add(std::string_view(hash_of_file(file)));
    hasher.add(std::string_view(std::filesystem::exists(sidecar) ? hash_of_file(sidecar) : ""));
    const MapDescription known = known_of(settings);
    hasher.add(known.scale.value_or(0));
    const auto add = [&](const std::optional<glm::dvec3>& vector) {
        const glm::dvec3 numbers = vector.value_or(glm::dvec3(0.0));
        hasher.add(vector.has_value()).add(numbers.x).add(numbers.y).add(numbers.z);
    };
    add(settings.lut_min);
    add(settings.lut_max);
    add(protocol.views.front().camera_position);
    add(protocol.views.front().camera_target);
    hasher.add(protocol.views.front().vertical_fov_deg.value_or(0.0))
        .add(protocol.motions.front().angle_of(frame).value);
    for (const AreaSettings& area : settings.areas)
        hasher.add(std::string_view(area.name)).add(area.spheres).add(area.boxes).add(area.planes);
    hasher.add(std::string_view(settings.id));
    return hasher.finish();
}

std::vector<std::string> check_given_maps(const Protocol& protocol, int object) {
    const PoseTable poses = distinct_poses(protocol.motions.front());
    std::atomic<int> mixed_maps{0}, unknown_cameras{0};
    std::atomic<unsigned> seen{0}; ///< areas, a bit each
    parallel_for(static_cast<int>(poses.angles.size()), [&](int pose) {
        const CoordinateImageFile map =
            read_given_map(protocol, object, first_frame_of(poses, PoseIndex{pose}));
        mixed_maps += map.mixed_px > 0;
        unknown_cameras += !map.description.camera || !map.description.bounds;
        seen |= std::accumulate(map.image.parts.begin(), map.image.parts.end(), 0u,
                                [](unsigned areas, PartIndex part) { return areas | part; });
    });
    const ObjectSettings& settings = protocol.objects[static_cast<std::size_t>(object)];
    for (std::size_t area = 0; area < settings.areas.size(); ++area) {
        if (!(seen >> area & 1u))
            throw InputError(
                fmt::format("object \"{}\": no pixel of its maps lies in its area \"{}\"; the area's "
                            "coordinates must be those of the maps",
                            settings.id, settings.areas[area].name));
    }
    std::vector<std::string> remarks;
    if (mixed_maps > 0) {
        remarks.push_back(fmt::format(
            "{} of {} maps have pixels that are partly covered, taken as background: they were filtered, and "
            "such pixels mix places; render maps with one sample in the middle of each pixel",
            mixed_maps.load(), poses.angles.size()));
    }
    if (unknown_cameras > 0) {
        remarks.emplace_back("depth and incidence will be missing, for the maps do not say where the camera "
                             "stood; a file beside each map, or [view], can");
    }
    return remarks;
}

} // namespace overt
