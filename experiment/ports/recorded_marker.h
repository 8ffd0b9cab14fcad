/// A marker and what became of it at one output, as the record keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/session_time.h"

namespace overt {

struct RecordedMarker {
    SessionTime at;     ///< when what it marks happened, such as a vertical blank
    int trial = -1;     ///< -1: outside of trials
    std::string output; ///< as the protocol calls it
    std::string text;   ///< such as "SYNCTIME"
    int code = 0;       ///< that was sent; 0: none, the text alone
    bool is_sent = true;
    /// It was handed to the system between these two, or that was tried; of an output that rides on the video
    /// signal, when its picture was handed over and when its outputs rose (MarkerOutputSettings::offset_ms).
    SessionTime not_before, not_after;
    std::optional<int> planned_refresh = {};     ///< of the presentation, from 0: for which it was meant
    std::optional<int> shown_refresh = {};       ///< at which it came, by the display's count
    int sitting = 1;                             ///< of one that was read
    std::optional<std::int64_t> attempt_id = {}; ///< of one that was read, in a trial: the attempt's id
};

} // namespace overt
