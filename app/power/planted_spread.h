/// Finds how to plant a stated difference of WSS.
#pragma once

#include <string>

#include "app/power/gaze_studies.h"

namespace overt {

/// Plants the effect of this index on WSS: simulates observers apart from all studies, and searches for the
/// spread with which the mean WSS of their trials in the level is `size` times that without the effect. Gives
/// a sentence on what was found. Throws InputError, with the ratios that can be had, if that is out of reach.
std::string plant_spread(GazeStudies& studies, std::size_t index, std::uint64_t seed, int jobs);

} // namespace overt
