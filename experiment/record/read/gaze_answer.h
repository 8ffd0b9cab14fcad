/// Where gaze was when an observer pressed a key to point with it.
#pragma once

#include <optional>
#include <string_view>

#include "experiment/record/read/session_record.h"

namespace overt {

// Values of an answer that is a place where gaze tells it, as GivenAnswer::value has them.
inline constexpr std::string_view pointed_by_gaze = "gaze", pointed_by_fixation = "fixation";

struct GazeOfAnswer {
    ScreenPoint place; ///< on the screen
    SessionTime at;    ///< when it was looked at
};

/// Of "gaze" the last sample of the analysed eye before the press, if it is no older than 50 ms and the eye
/// was there; of "fixation" the last fixation that began before the press: its place, and its end or the
/// press, whichever came first. Nothing of other answers, of one that was missed, and without readings of
/// both clocks. Throws RecordError.
std::optional<GazeOfAnswer> gaze_of_answer(const SessionRecord& record, const TrialRecord& trial,
                                           const GivenAnswer& given);

} // namespace overt
