#include "experiment/analysis/gaze_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Standard deviation below which pixels are too coarse for the cone.
constexpr double narrow_px = 4.0;

const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));

} // namespace

GazeCone::GazeCone(const ScreenGeometry& screen, Degrees accuracy, int directions)
    : screen_(screen), sigma_{accuracy.value * std::sqrt(2.0 / std::numbers::pi)},
      is_narrow_(sigma_.value * screen.px_per_deg_at_centre() < narrow_px) {
    OVERT_EXPECTS(accuracy.value >= 0.0 && directions > 0);
    for (int i = 0; i < directions; ++i) {
        // Within the angle r sigma a normal distribution on a plane has 1 - exp(-r² / 2) of its mass.
        const double mass = (i + 0.5) / directions;
        const double off_rad = to_radians(sigma_).value * std::sqrt(-2.0 * std::log1p(-mass));
        const double turn_rad = golden_angle_rad * i;
        directions_.push_back({std::sin(off_rad) * std::cos(turn_rad), std::sin(off_rad) * std::sin(turn_rad),
                               std::cos(off_rad)});
    }
}

/// Calls visit(image point) for each direction that meets the screen's plane.
template <class Visit> void GazeCone::for_each_place(ScreenPoint gaze, const Visit& visit) const {
    const glm::dvec2 mm_per_px = screen_.screen_mm / glm::dvec2(screen_.screen_px);
    const ScreenPoint centre = screen_.centre();
    const glm::dvec3 towards =
        glm::normalize(glm::dvec3((gaze.x_px - centre.x_px) * mm_per_px.x,
                                  (gaze.y_px - centre.y_px) * mm_per_px.y, screen_.viewing_distance_mm));
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), towards));
    const glm::dvec3 along = glm::cross(towards, across);
    const glm::dvec2 px_at_unit_depth = screen_.viewing_distance_mm / mm_per_px;
    const glm::dvec2 centre_in_image = screen_.image_from_screen(centre);
    for (const Direction& direction : directions_) {
        const glm::dvec3 sight =
            direction.across * across + direction.along * along + direction.forward * towards;
        if (sight.z > 0.0)
            visit(centre_in_image + glm::dvec2(sight) / sight.z * px_at_unit_depth);
    }
}

GazeCone::Shares GazeCone::shares(const SurfaceLookup& lookup, PoseIndex pose, ScreenPoint gaze,
                                  std::size_t parts) const {
    Shares shares{0.0, std::vector<double>(parts, 0.0)};
    for_each_place(gaze, [&](glm::dvec2 place) {
        std::optional<PartIndex> part;
        if (is_narrow_) {
            if (const auto surface = lookup.surface_at(pose, place))
                part = surface->part;
        } else {
            part = lookup.part_near(pose, place);
        }
        if (part && *part < parts) {
            shares.of_part[*part] += 1.0; // whole numbers: their sums are exact
            shares.of_object += 1.0;
        }
    });
    const auto directions = static_cast<double>(directions_.size());
    shares.of_object /= directions;
    for (double& share : shares.of_part)
        share /= directions;
    return shares;
}

std::vector<WeightedSurfacePoint> GazeCone::on_surface(const SurfaceLookup& lookup, PoseIndex pose,
                                                       ScreenPoint gaze) const {
    std::vector<WeightedSurfacePoint> points;
    const double weight = 1.0 / static_cast<double>(directions_.size());
    for_each_place(gaze, [&](glm::dvec2 place) {
        if (const auto surface = lookup.surface_at(pose, place))
            points.push_back({*surface, weight});
    });
    return points;
}

} // namespace overt
