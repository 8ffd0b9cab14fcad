/// One observer's sitting from consent to farewell: what comes when. How each part is done is in its own
/// file.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiment/design/block_feedback.h"
#include "experiment/design/trial_queue.h"
#include "experiment/protocol/protocol.h"
#include "experiment/session/operator_control.h"
#include "experiment/session/session_ports.h"
#include "experiment/session/session_state.h"
#include "experiment/session/trial_run.h"
#include "experiment/trial.h"

namespace overt {

struct SessionResult {
    int completed_trials = 0;
    bool aborted = false;   ///< by observer or operator, or because the display or the tracker went away
    std::string reason;     ///< why, if aborted
    bool is_opened = false; ///< the observer takes part: there is something to go on with
    int missed_refreshes = 0;
    std::vector<std::string> marker_warnings; ///< sentences: what outputs of markers failed at, as recorded
};

class Session {
  public:
    /// Told after each trial; `done` counts completed ones.
    using TrialDone = std::function<void(const Trial& trial, const TrialOutcome& outcome, int done)>;

    /// `protocol` and `schedule` must outlive the session. `fields`: what of the observer's form is filled in
    /// already.
    Session(const Protocol& protocol, const Schedule& schedule, const ScreenPoint& screen_centre,
            SessionPorts ports, FieldValues fields = {});

    /// Runs all trials in their order, with what comes before, between and after them. An attempt that does
    /// not count is recorded as aborted. Throws DeviceError, GraphicsError or RecordError for what breaks
    /// between trials; what happens within one is in its outcome. `history`: of an interrupted session, that
    /// is taken up where it stood; its last step is that of being resumed.
    SessionResult run(const TrialDone& trial_done, const SessionHistory& history = {});

  private:
    void run_step(TrialQueue& queue, const SessionStep& step, SessionResult& result,
                  const TrialDone& trial_done);
    void give_feedback(int block);
    void take_answers(const SessionHistory& history);
    void run_instructions(const SessionStep& step);
    void run_practice(const SessionStep& step, const std::optional<Trial>& next);
    void run_break();
    void judge(TrialQueue& queue, const Trial& trial, TrialRun::Attempt& attempt);
    void farewell();
    void ask_after_block(int block);
    void ask_at(const std::string& when);

    std::map<int, AnsweredTrials> answered_; ///< by block
    const Schedule& schedule_;
    SessionPorts ports_;
    SessionState state_;
    OperatorControl control_;
    TrialRun trials_;
    FieldValues fields_;
    std::vector<std::string> forms_done_; ///< parts of the form that are in the record already
    int block_ = -1;                      ///< of the last trial
};

} // namespace overt
