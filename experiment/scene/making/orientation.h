/// On which side of a line a point lies, without an error.
#pragma once

#include <glm/glm.hpp>

namespace overt {

/// 1 if a, b, c go round counter-clockwise, -1 if clockwise, 0 if they lie on one line. Exact, for
/// coordinates whose products neither overflow nor underflow. A filter answers nearly all calls (Shewchuk
/// 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete
/// Comput. Geom. 18).
int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) noexcept;

} // namespace overt
