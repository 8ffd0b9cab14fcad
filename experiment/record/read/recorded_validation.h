/// What a calibration's validation found, out of the session's events.
#pragma once

#include <optional>

#include "experiment/ports/eye_tracker.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Nothing if the event is none. Of an event whose words say no errors, nothing, too.
std::optional<ValidationResult> validation_of(const RecordedEvent& event);

} // namespace overt
