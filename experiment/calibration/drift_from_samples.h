/// A check of drift for trackers that have none of their own.
#pragma once

#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// Records until gaze rests, at most for `patience`, and compares it with a target that is shown now; of two
/// eyes the mean of their places. Throws DeviceError if the tracker does not begin to record.
DriftOutcome drift_from_samples(EyeTracker& tracker, Clock& clock, const ScreenGeometry& screen,
                                ScreenPoint target, SessionDuration patience = std::chrono::seconds(2));

/// How often samples are taken while gaze is waited for.
inline constexpr SessionDuration between_looks = std::chrono::milliseconds(4);

} // namespace overt
