#include "experiment/ports/session_phase.h"

#include <initializer_list>

namespace overt {

namespace {

using enum SessionPhase;

bool is_one_of(SessionPhase phase, std::initializer_list<SessionPhase> phases) {
    for (const SessionPhase one : phases)
        if (one == phase)
            return true;
    return false;
}

/// A text or the drift target stands on the screen there, or the stimulus is over: the operator may pause or
/// calibrate.
bool can_be_interrupted(SessionPhase phase) {
    return is_one_of(
        phase, {set_up, block, task_screen, drift_check, stimulus, response_screen, feedback, rest, pause});
}

} // namespace

bool may_follow(SessionPhase from, SessionPhase to) {
    // Whatever the plan has next when a trial or a text is over.
    const std::initializer_list<SessionPhase> between{block, trial, rest};
    if (to == end)
        return true;
    if ((to == pause || to == calibration) && (can_be_interrupted(from) || from == calibration))
        return true;
    switch (from) {
    case set_up:
    case block:
    case rest:
    case feedback:
        return is_one_of(to, between);
    case trial:
        return is_in_trial(to);
    case task_screen:
    case drift_check:
    case stimulus:
        return (to != from && is_in_trial(to)) || is_one_of(to, between);
    case response_screen:
        return to == feedback || (to != from && is_in_trial(to)) || is_one_of(to, between);
    case calibration:
    case pause:
        return can_be_interrupted(to) || is_one_of(to, between);
    case end:
        return false;
    }
    return false;
}

} // namespace overt
