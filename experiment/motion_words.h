/// Motions in words, for reports.
#pragma once

#include <string>

#include "experiment/animation.h"

namespace overt {

/// What the object does while the frames go by once: "25 deg to each side", "once all the way round,
/// clockwise".
std::string way_of(const Animation& motion);

/// The same of the light by itself; empty if it stands. What the light does by the motion's kind is not in
/// it.
std::string way_of_light(const Animation& motion);

} // namespace overt
