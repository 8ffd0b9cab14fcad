/// What the figures stand on.
#pragma once

#include "experiment/scene/sculptures/clay.h"

namespace overt {

/// Height of all plinths, mm.
inline constexpr double plinth_height_mm = 60.0;

/// Round plinth with a moulding at foot and top, base at z = 0.
Clay round_plinth(double radius_mm);

/// Rectangular plinth with a moulding at foot and top, base at z = 0.
Clay square_plinth(const glm::dvec2& half_size_mm);

/// Rough-hewn block of stone whose base is sunk into z = `base_z`.
Clay rock(const glm::dvec3& base_centre, const glm::dvec3& half_size_mm);

/// Posture of a trunk or head: turned towards the figure's left, bowed forwards and tilted to the left.
glm::dmat3 posture(double turn_deg, double bow_deg, double tilt_deg);

} // namespace overt
