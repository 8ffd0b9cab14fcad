/// What BIDS wants to know of an eye tracker and its calibration.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Sampling rate, tracker, how it tracks, how often and with how many targets it was calibrated for this eye
/// in the run and what the last validation gave: of an imported recording by the tracker's own messages, else
/// by the session's record. What neither tells is left out. Throws RecordError.
nlohmann::ordered_json bids_tracker(const SessionRecord& record, int run, Eye eye);

} // namespace overt
