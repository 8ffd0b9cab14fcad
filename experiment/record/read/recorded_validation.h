/// What a calibration's validation found, out of the session's events.
#pragma once

#include <optional>

#include "experiment/ports/eye_tracker.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Nothing if the event is none. Of an event whose words say no errors, nothing, too.
std::optional<ValidationResult> validation_of(const RecordedEvent& event);

/// What a validation found of one eye. Where its targets are not known, the sums are those of both.
struct ValidationOfEye {
    Degrees mean_error, max_error;
    std::vector<ValidatedTarget> targets;
};
ValidationOfEye validation_of_eye(const ValidationResult& validation, Eye eye);

} // namespace overt
