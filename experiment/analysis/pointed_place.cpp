#include "experiment/analysis/pointed_place.h"

#include <algorithm>
#include <cmath>

namespace overt {

glm::dmat2 covariance_of_pixel() { return glm::dmat2(1.0 / 12.0); }

glm::dmat2 covariance_of_gaze(const ScreenGeometry& screen, ScreenPoint gaze, Degrees sigma) {
    const glm::dvec2 mm_per_px = screen.screen_mm / glm::dvec2(screen.screen_px);
    const ScreenPoint centre = screen.centre();
    const glm::dvec2 off_mm = glm::dvec2(gaze.x_px - centre.x_px, gaze.y_px - centre.y_px) * mm_per_px;
    const double distance = screen.viewing_distance_mm, off = glm::length(off_mm);
    const double range = std::hypot(distance, off);
    const double away_sd = to_radians(sigma).value * range * range / distance,
                 across_sd = to_radians(sigma).value * range;
    const glm::dvec2 away = off > 0.0 ? off_mm / off : glm::dvec2(1.0, 0.0), across(-away.y, away.x);
    const glm::dmat2 in_mm = away_sd * away_sd * glm::outerProduct(away, away) +
                             across_sd * across_sd * glm::outerProduct(across, across);
    const glm::dmat2 px_from_mm(1.0 / mm_per_px.x, 0.0, 0.0, 1.0 / mm_per_px.y);
    return px_from_mm * in_mm * px_from_mm;
}

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    return {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]};
}

std::optional<SurfaceFootprint> footprint_of(const SightLines& lines, glm::dvec2 image_point_px,
                                             const std::array<glm::dvec3, 3>& corners,
                                             const glm::dmat2& covariance_px) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 direction = lines.direction_through(image_point_px);
    const double facing = glm::dot(normal, direction);
    if (!(std::abs(facing) > 0.0))
        return std::nullopt;
    const double depth = glm::dot(normal, corners[0] - lines.origin()) / facing;
    // Directions change evenly from pixel to pixel.
    const auto moves = [&](glm::dvec2 by_px) {
        const glm::dvec3 change = lines.direction_through(image_point_px + by_px) - direction;
        return depth * (change - direction * (glm::dot(normal, change) / facing));
    };
    const glm::mat<2, 3, double> jacobian(moves({1.0, 0.0}), moves({0.0, 1.0}));
    SurfaceFootprint footprint;
    footprint.covariance = jacobian * covariance_px * glm::transpose(jacobian);
    // Of rank 2: its two eigenvalues other than 0 have the trace for their sum, and the sum of the principal
    // minors of second order for their product.
    const glm::dmat3& c = footprint.covariance;
    const double sum = c[0][0] + c[1][1] + c[2][2];
    const double product = c[0][0] * c[1][1] - c[0][1] * c[1][0] + c[0][0] * c[2][2] - c[0][2] * c[2][0] +
                           c[1][1] * c[2][2] - c[1][2] * c[2][1];
    const double root = std::sqrt(std::max(0.0, 0.25 * sum * sum - product));
    const double larger = 0.5 * sum + root;
    footprint.largest_sd = std::sqrt(larger);
    // By their product: the difference of nearly equal numbers would lose the smaller one.
    footprint.smallest_sd = larger > 0.0 ? std::sqrt(std::max(0.0, product) / larger) : 0.0;
    return footprint;
}

} // namespace overt
