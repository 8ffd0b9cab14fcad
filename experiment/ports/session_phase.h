/// Where a session stands.
#pragma once

#include <cstdint>
#include <string_view>

#include "experiment/base/enum_names.h"

namespace overt {

enum class SessionPhase : std::uint8_t {
    set_up,      ///< consent, form, welcome and instructions
    calibration, ///< also in between, when the operator asks for it
    block,       ///< a block's instructions
    trial,       ///< a trial's stimulus is made ready
    task_screen,
    drift_check,
    stimulus,
    response_screen,
    feedback, ///< after a practice trial
    rest,     ///< a break that the protocol has
    pause,    ///< one that the operator makes
    end
};
/// As the record and the command line have them.
template <>
inline constexpr auto names_of<SessionPhase> = enum_names<SessionPhase>("set-up", "calibration", "block",
                                                                        "trial", "task screen", "drift check",
                                                                        "stimulus", "response screen",
                                                                        "feedback", "rest", "pause", "end");
inline constexpr int session_phase_count = static_cast<int>(names_of<SessionPhase>.size());

/// Whether a session may go from one phase to the other. Pauses and calibrations between trials or on their
/// screens lead back to where they came from.
bool may_follow(SessionPhase from, SessionPhase to);

/// Whether a trial is under way, which the operator can reject, repeat or skip.
constexpr bool is_in_trial(SessionPhase phase) {
    return phase == SessionPhase::task_screen || phase == SessionPhase::drift_check ||
           phase == SessionPhase::stimulus || phase == SessionPhase::response_screen;
}

/// The event of each change of phase; its detail is the new phase's name.
inline constexpr std::string_view phase_event = "phase";

} // namespace overt
