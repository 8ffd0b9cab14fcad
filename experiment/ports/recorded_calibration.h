/// A calibration of the eye tracker, for the record.
#pragma once

#include <string>

#include "experiment/ports/validation.h"
#include "experiment/session_time.h"

namespace overt {

/// A set-up of the tracker that came to its end.
struct RecordedCalibration {
    SessionTime at;
    int trial = -1;     ///< -1: outside of trials
    std::string method; ///< see SetupOutcome
    ValidationResult validation;
    bool is_within_limits = true; ///< of the protocol; else the operator went on with it all the same
};

} // namespace overt
