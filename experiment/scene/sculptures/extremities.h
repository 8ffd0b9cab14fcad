/// Hands and feet.
#pragma once

#include <array>

#include "experiment/scene/sculptures/clay.h"

namespace overt {

/// How a hand is held; angles in degrees.
struct HandShape {
    std::array<double, 4> curl_deg{25, 30, 35, 40}; ///< bend at each joint, forefinger to little finger
    double thumb_spread_deg = 35;                   ///< away from the forefinger
};

/// A right hand about its wrist, unit length to the tip of the middle finger: fingers along +z, the palm
/// faces -y, the thumb on the side of +x.
Clay sculpt_hand(const HandShape& shape);

/// A right foot about the point on the ground below its ankle, unit length from heel to toe: toes along -y,
/// the sole at z = 0, the great toe on the side of +x.
Clay sculpt_foot();

} // namespace overt
