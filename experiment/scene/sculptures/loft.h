/// Limbs and trunks: cross-sections along a bent axis.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/sculptures/clay.h"

namespace overt {

/// An elliptical section of a loft.
struct LoftSection {
    double along;             ///< share of the axis, 0 at its start, 1 at its end
    double half_side;         ///< mm
    double half_front;        ///< mm
    double side_shift = 0.0;  ///< centre off the axis, mm
    double front_shift = 0.0; ///< mm
};

/// The axis of a loft, which runs as a quadratic curve, and the direction that is its front at either end.
struct LoftAxis {
    glm::dvec3 start, control, end;
    glm::dvec3 front_at_start, front_at_end; ///< need not be at right angles to the axis
    glm::dvec3 side; ///< says roughly where the side lies that side_shift counts towards

    /// A straight axis with one front.
    static LoftAxis straight(const glm::dvec3& start, const glm::dvec3& end, const glm::dvec3& front,
                             const glm::dvec3& side) {
        return {start, 0.5 * (start + end), end, front, front, side};
    }
};

/// The solid through at least three sections, in ascending order from 0 to 1. Between them all five numbers
/// run as natural cubic splines, so the surface has continuous curvature. Ends are rounded; `cap` is the
/// height of the rounding relative to the end section's lesser half axis.
Shape loft(const LoftAxis& axis, const std::vector<LoftSection>& sections, double cap = 0.7);

} // namespace overt
