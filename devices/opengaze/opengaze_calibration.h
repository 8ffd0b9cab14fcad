/// A calibration by an Open Gaze server, whose targets the set-up screen shows.
#pragma once

#include "devices/opengaze/opengaze_link.h"
#include "devices/opengaze/opengaze_tracker.h"

namespace overt {

struct OpenGazeCalibration {
    const OpenGazeSettings& settings;
    const TrackerWish& wish;
    const Clock& clock;
};

/// Has the server go through its targets, shows each on the set-up screen when the server comes to it, and
/// gives where each eye was measured. These are the errors of the calibration at its own targets; the server
/// has no validation. Throws DeviceError if the line is lost or the server does not begin.
SetupOutcome calibrate_opengaze(OpenGazeLink& link, SetupScreen& setup_screen,
                                const OpenGazeCalibration& calibration);

/// What a calibration's result says of the eyes that are measured. Targets of an eye that was not valid have
/// no gaze and no part in the means.
SetupOutcome outcome_of(const OpenGazeMessage& result, const OpenGazeSettings& settings,
                        const TrackerWish& wish);

} // namespace overt
