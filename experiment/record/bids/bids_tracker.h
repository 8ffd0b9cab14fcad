/// What BIDS wants to know of an eye tracker and its calibration.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Sampling rate, tracker, how often it was calibrated for this eye in the run and what the last validation
/// gave: of an imported recording by the tracker's own messages, else by the session's events. Throws
/// RecordError.
nlohmann::ordered_json bids_tracker(const SessionRecord& record, int run, Eye eye);

} // namespace overt
