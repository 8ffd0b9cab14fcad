#include "experiment/maps/coordinate_image_lookup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/maps/surface_walk.h"

namespace overt {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double of_usual_step = 3.0, of_following_step = 2.0;

/// Median distance between the places of horizontal neighbours.
double median_step(const CoordinateImage& image) {
    std::vector<float> steps;
    for (int y = 0; y < image.size_px.y; ++y) {
        for (int x = 0; x + 1 < image.size_px.x; ++x) {
            if (image.covers(x, y) && image.covers(x + 1, y))
                steps.push_back(glm::distance(glm::vec3(image.at(x, y)), glm::vec3(image.at(x + 1, y))));
        }
    }
    if (steps.empty())
        return 0.0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return double{*middle};
}

} // namespace

CoordinateImageLookup::CoordinateImageLookup(std::vector<CoordinateImageFile> maps, glm::ivec2 image_px)
    : CoordinateImageLookup(
          maps.size(), [&](PoseIndex pose) { return std::move(maps[static_cast<std::size_t>(pose.value)]); },
          image_px) {}

CoordinateImageLookup::CoordinateImageLookup(std::size_t poses,
                                             const std::function<CoordinateImageFile(PoseIndex)>& map_of,
                                             glm::ivec2 image_px)
    : image_px_(image_px) {
    std::vector<std::optional<Patches>> patches(poses);
    parallel_for(static_cast<int>(poses), [&](int pose) {
        const CoordinateImageFile map = map_of({pose});
        if (map.image.size_px != image_px) {
            throw InputError(fmt::format("a map of {} x {} pixels was given for an image of {} x {}",
                                         map.image.size_px.x, map.image.size_px.y, image_px.x, image_px.y));
        }
        patches[static_cast<std::size_t>(pose)].emplace(patches_of(map, image_px));
    });
    patches_.reserve(poses);
    for (std::optional<Patches>& of_pose : patches)
        patches_.push_back(*std::move(of_pose));
}

CoordinateImageLookup::Patches CoordinateImageLookup::patches_of(const CoordinateImageFile& map,
                                                                 glm::ivec2 image_px) {
    const CoordinateImage& image = map.image;
    TriangleMap numbers{image_px, std::vector<std::uint32_t>(image.pixels.size(), 0)};
    std::vector<glm::vec3> places;
    std::vector<PartIndex> parts;
    places.reserve(image.covered_pixels());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (image.pixels[i].w == 0.0f)
            continue;
        places.emplace_back(image.pixels[i]);
        if (!image.parts.empty())
            parts.push_back(image.parts[i]);
        numbers.codes[i] = static_cast<std::uint32_t>(places.size());
    }
    Patches patches{PoseCells(numbers), std::move(places), std::move(parts), median_step(image),
                    std::nullopt};
    const MapDescription& description = map.description;
    if (description.camera && description.bounds && description.angle)
        patches.sight.emplace(SceneView{{*description.camera, image_px}, *description.bounds},
                              ObjectPose{*description.angle});
    return patches;
}

const glm::vec3* CoordinateImageLookup::place_of(const Patches& patches, glm::ivec2 pixel) {
    if (!patches.cells.is_inside(pixel))
        return nullptr;
    const PixelCell cell = patches.cells.cell(pixel);
    return cell.is_covered() ? &patches.places[cell.triangle()] : nullptr;
}

bool CoordinateImageLookup::belong_together(const Patches& patches, glm::ivec2 pixel, glm::ivec2 step) {
    const glm::vec3 *one = place_of(patches, pixel), *other = place_of(patches, pixel + step);
    if (!one || !other)
        return false;
    const auto apart = double{glm::distance(*one, *other)};
    if (apart <= of_usual_step * patches.usual_step)
        return true;
    const glm::vec3 *before = place_of(patches, pixel - step), *behind = place_of(patches, pixel + 2 * step);
    return (before && apart <= of_following_step * double{glm::distance(*before, *one)}) ||
           (behind && apart <= of_following_step * double{glm::distance(*behind, *other)});
}

glm::dvec3 CoordinateImageLookup::slope_along(const Patches& patches, glm::ivec2 pixel, glm::ivec2 step) {
    for (const glm::ivec2 side : {step, -step}) {
        if (belong_together(patches, pixel, side)) {
            const glm::dvec3 change =
                glm::dvec3(*place_of(patches, pixel + side)) - glm::dvec3(*place_of(patches, pixel));
            return side == step ? change : -change;
        }
    }
    return glm::dvec3(0.0);
}

std::optional<double> CoordinateImageLookup::incidence_rad(const Patches& patches, const Slopes& slopes,
                                                           glm::dvec2 image_point_px) {
    const glm::dvec3 normal = glm::cross(slopes.right, slopes.down);
    const double length = glm::length(normal);
    if (!patches.sight || length == 0.0)
        return std::nullopt;
    const glm::dvec3 sight = glm::normalize(patches.sight->direction_through(image_point_px));
    return std::acos(std::min(1.0, std::abs(glm::dot(normal, sight)) / length));
}

std::optional<SurfacePoint> CoordinateImageLookup::surface_at(PoseIndex pose, glm::dvec2 point) const {
    // Also turns away what is not a number.
    if (!(point.x >= 0.0 && point.y >= 0.0 && point.x < image_px_.x && point.y < image_px_.y))
        return std::nullopt;
    const Patches& patches = patches_[static_cast<std::size_t>(pose.value)];
    const glm::ivec2 pixel(glm::floor(point));
    const glm::vec3* const own = place_of(patches, pixel);
    if (!own)
        return std::nullopt;
    const glm::dvec2 off_centre = point - (glm::dvec2(pixel) + 0.5);
    const glm::ivec2 across(off_centre.x >= 0.0 ? 1 : -1, 0), along(0, off_centre.y >= 0.0 ? 1 : -1);
    const glm::dvec2 share = glm::abs(off_centre);
    const glm::dvec3 change_across = slope_along(patches, pixel, across),
                     change_along = slope_along(patches, pixel, along);

    SurfacePoint surface;
    surface.position = glm::dvec3(*own) + share.x * change_across + share.y * change_along;
    const bool is_whole = belong_together(patches, pixel, across) && belong_together(patches, pixel, along) &&
                          belong_together(patches, pixel + across, along) &&
                          belong_together(patches, pixel + along, across);
    if (is_whole) {
        // What bilinear interpolation has more than the two slopes.
        const glm::dvec3 twist = glm::dvec3(*place_of(patches, pixel + across + along)) -
                                 glm::dvec3(*place_of(patches, pixel + across)) -
                                 glm::dvec3(*place_of(patches, pixel + along)) + glm::dvec3(*own);
        surface.position += share.x * share.y * twist;
    }
    surface.triangle = no_triangle;
    if (!patches.parts.empty())
        surface.part = patches.parts[patches.cells.cell(pixel).triangle()];
    surface.depth = patches.sight ? patches.sight->project(surface.position).z : nothing;
    const auto incidence = incidence_rad(patches, {change_across, change_along}, point);
    surface.incidence = incidence ? to_degrees({*incidence}) : Degrees{nothing};
    return surface;
}

void CoordinateImageLookup::look(std::span<const ImagePlace> places, std::span<Sight* const> sights) const {
    OVERT_EXPECTS(places.size() == sights.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [pose, point] = places[i];
        sights[i]->surface = surface_at(pose, point);
        sights[i]->outline_px = patches_[static_cast<std::size_t>(pose.value)].cells.outline_near(
            point, sights[i]->surface.has_value());
    }
}

} // namespace overt
