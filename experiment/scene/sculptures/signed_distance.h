/// Signed distances of simple solids and the operations that join them without an edge. Lengths in mm;
/// negative inside. Distances are exact or first-order: near the surface the gradient has length 1 or nearly
/// so.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace overt {

/// Ball that holds a solid; what is outside need not be asked.
struct Ball {
    glm::dvec3 centre{0.0};
    double radius = 0.0;

    /// Least distance that anything in the ball can have from `point`; negative inside the ball.
    double distance(const glm::dvec3& point) const { return glm::distance(point, centre) - radius; }
};

/// The smallest ball around two balls.
inline Ball enclosing_ball(const Ball& a, const Ball& b) {
    const glm::dvec3 between = b.centre - a.centre;
    const double distance = glm::length(between);
    if (a.radius >= distance + b.radius)
        return a;
    if (b.radius >= distance + a.radius)
        return b;
    const double radius = 0.5 * (distance + a.radius + b.radius);
    return {a.centre + between * ((radius - a.radius) / distance), radius};
}

/// Union whose seam is filled within `blend_mm` of both surfaces. The cubic weight keeps the curvature
/// continuous, so that the seam does not show as a kink in a mirror; it adds blend_mm / 6 where both are
/// equal.
inline double smooth_union(double a, double b, double blend_mm) {
    const double overlap = blend_mm - std::abs(a - b);
    const double least = std::min(a, b);
    if (overlap <= 0.0)
        return least;
    const double share = overlap / blend_mm;
    return least - share * share * share * blend_mm / 6.0;
}

/// Intersection with a rounded edge, the mirror image of smooth_union.
inline double smooth_intersection(double a, double b, double blend_mm) {
    return -smooth_union(-a, -b, blend_mm);
}

/// 0 below 0, 1 above 1, and in between a rise with continuous curvature at both ends.
inline double smooth_step(double t) {
    const double s = std::clamp(t, 0.0, 1.0);
    return s * s * s * (s * (6.0 * s - 15.0) + 10.0);
}

/// First-order distance of an ellipsoid about the origin, given by its three half axes.
inline double ellipsoid_distance(const glm::dvec3& point, const glm::dvec3& half_axes_mm) {
    const glm::dvec3 scaled = point / half_axes_mm;
    const double size = glm::length(scaled);
    const double slope = glm::length(scaled / half_axes_mm);
    if (slope < 1e-9)
        return -std::min({half_axes_mm.x, half_axes_mm.y, half_axes_mm.z});
    return size * (size - 1.0) / slope;
}

/// Exact distance of two balls and the cone that touches both.
inline double round_cone_distance(const glm::dvec3& point, const Ball& a, const Ball& b) {
    const glm::dvec3 axis = b.centre - a.centre;
    const double length_squared = glm::dot(axis, axis);
    const double shrinking = a.radius - b.radius;
    const double slant_squared = length_squared - shrinking * shrinking;
    const glm::dvec3 from_a = point - a.centre;
    if (slant_squared <= 0.0)
        return std::min(a.distance(point), b.distance(point));
    const double along = glm::dot(from_a, axis);
    const double beyond = along - length_squared;
    const glm::dvec3 across = from_a * length_squared - axis * along;
    const double across_squared = glm::dot(across, across);
    const double beyond_squared = beyond * beyond * length_squared;
    const double along_squared = along * along * length_squared;
    const double tilt = std::copysign(1.0, shrinking) * shrinking * shrinking * across_squared;
    if (std::copysign(1.0, beyond) * slant_squared * beyond_squared > tilt)
        return std::sqrt(across_squared + beyond_squared) / length_squared - b.radius;
    if (std::copysign(1.0, along) * slant_squared * along_squared < tilt)
        return std::sqrt(across_squared + along_squared) / length_squared - a.radius;
    return (std::sqrt(across_squared * slant_squared / length_squared) + along * shrinking) / length_squared -
           a.radius;
}

/// Exact distance of a box about the origin with rounded edges; the half sizes include the rounding.
inline double rounded_box_distance(const glm::dvec3& point, const glm::dvec3& half_size_mm,
                                   double rounding_mm) {
    const glm::dvec3 over = glm::abs(point) - half_size_mm + rounding_mm;
    return glm::length(glm::max(over, glm::dvec3(0.0))) + std::min(0.0, std::max({over.x, over.y, over.z})) -
           rounding_mm;
}

} // namespace overt
