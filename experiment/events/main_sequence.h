/// How the eye moves in a saccade.
#pragma once

#include "experiment/session_time.h"
#include "experiment/units.h"

namespace overt {

/// 21 ms + 2.2 ms for each degree: Carpenter, "Movements of the Eyes", 2nd edition 1988.
SessionDuration saccade_duration(Degrees amplitude);

/// Share of the way done after a share (0 … 1) of a saccade's duration: the path of least jerk, with a peak
/// velocity of 1.875 times the mean. Flash and Hogan, J. Neurosci. 5(7), 1985.
double saccade_progress(double share);

} // namespace overt
