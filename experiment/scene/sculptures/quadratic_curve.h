/// A quadratic Bezier curve in space, and the nearest point on it.
#pragma once

#include <glm/glm.hpp>

namespace overt {

/// Curve from a to b; `control` is where the end tangents meet.
struct QuadraticCurve {
    glm::dvec3 a, control, b;

    glm::dvec3 at(double t) const { return glm::mix(glm::mix(a, control, t), glm::mix(control, b, t), t); }
    glm::dvec3 derivative(double t) const { return 2.0 * glm::mix(control - a, b - control, t); }

    /// Parameter in [0, 1] of the point nearest to `point`: the exact roots of the cubic equation.
    double nearest(const glm::dvec3& point) const;
};

} // namespace overt
