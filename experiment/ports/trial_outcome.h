/// How an attempt at a trial went.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/attempt_step.h"
#include "experiment/ports/gaze_yield.h"
#include "experiment/ports/given_answer.h"
#include "experiment/ports/shown_probe.h"
#include "experiment/session_time.h"
#include "experiment/swap_modes.h"
#include "experiment/units.h"

namespace overt {

/// How a trial went.
struct TrialOutcome {
    enum class Status : std::uint8_t { completed, aborted };
    /// Whether the trial is attempted again, as far as that is decided.
    enum class Afterwards : std::uint8_t { undecided, never, now, end_of_block };
    Status status = Status::completed;
    std::string failure;                           ///< by which it does not count, or would not; empty: none
    Afterwards afterwards = Afterwards::undecided; ///< undecided: the session ended in it
    SessionTime task_screen_onset, presentation_onset, presentation_end, response_screen_onset, responded_at;
    /// Of responded_at, at a keyboard; nothing where it is exact, or a response box's own.
    std::optional<SessionDuration> responded_uncertainty = {};
    int shown_refreshes = 0;
    int missed_refreshes = 0;
    /// Of the presentation's pictures and the dark screen after them; nothing where no server tells it.
    std::optional<SwapModes> swaps = {};
    /// Of the recording around the presentation, by the session's own tracker; nothing without one, and of an
    /// attempt that did not come to it.
    std::optional<GazeYield> gaze = {};
    std::optional<Degrees> drift;
    std::string answer;
    /// Of the trial's plan, in its order; one that began anew has a row for each time. None of imported
    /// trials, and of sessions of earlier programs.
    std::vector<AttemptStep> steps = {};
    /// Of a task with [[task.answer]]: a row for each that was asked, missed ones too, and what was done
    /// meanwhile, in time.
    std::vector<GivenAnswer> given = {};
    std::vector<AnswerInput> inputs = {};
    /// A row for each probe of each step that showed it, in time.
    std::vector<ShownProbe> probes = {};
    /// Further trials that do not come, since by this one the criterion of their block was met; indices.
    std::vector<int> left_out = {};
};

} // namespace overt
