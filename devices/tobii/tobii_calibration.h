/// A calibration by a tracker of Tobii's, at targets that the set-up screen shows.
#pragma once

#include "devices/tobii/tobii_driver.h"

namespace overt {

/// Shows each target, has the tracker measure there, a second time where it could not, and then compute and
/// apply. Escape ends it; a measurement that is under way is waited for, since the library has no way to end
/// it. Gives what the tracker measured at its own targets: it has no validation. Throws DeviceError if the
/// tracker cannot calibrate, or if the library does not answer within settings.calibration_patience.
SetupOutcome calibrate_tobii(std::shared_ptr<const TobiiLibrary> library, TobiiEyeTracker* tracker,
                             SetupScreen& setup_screen, const TobiiSettings& settings,
                             const TrackerWish& wish);

} // namespace overt
