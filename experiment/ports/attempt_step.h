/// A step of an attempt at a trial, as it was planned and as it went.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/session_time.h"

namespace overt {

/// Why a step ended.
enum class StepEnd : std::uint8_t {
    time,
    key,      ///< of the observer
    answer,   ///< was given
    gaze,     ///< came to where it was waited for
    patience, ///< it did not come in time
    done,     ///< what the step does was done: a drift check
    stopped   ///< by the operator, the eye tracker, the display, or since gaze did not come
};
template <>
inline constexpr auto names_of<StepEnd> = enum_names<StepEnd>("time", "key", "answer", "gaze", "patience",
                                                              "done", "stopped");

struct AttemptStep {
    std::string kind;                     ///< as a protocol has it
    std::string id;                       ///< empty: none was given
    std::optional<int> planned_refreshes; ///< nothing: no time ends it
    std::optional<double> drawn_s;        ///< before it was rounded to refreshes
    std::optional<int> still_frame;       ///< the only one that a step `show` shows
    /// Which of what the trial shows (Trial::shown) a step `show` lit, rising. Nothing of other steps, and of
    /// sessions of earlier programs, whose trials showed all at once.
    std::optional<std::vector<int>> places = {};
    /// When what it shows was lit, and when something else was; nothing of a step that was not come to.
    std::optional<SessionTime> begin, end;
    std::optional<StepEnd> ended_by;
    /// Where gaze was waited for: the first sample of the piece that was long enough, and the one by which it
    /// was.
    std::optional<TrackerTime> gaze_onset, gaze_detected;

    /// Whether it is a step `show` that lights this of what the trial shows.
    bool lights(int place) const {
        return kind == "show" && (!places || std::ranges::find(*places, place) != places->end());
    }
};

} // namespace overt
