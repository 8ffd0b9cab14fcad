/// One observer's sitting, from the welcome to the farewell: the order of things, and nothing of how they are
/// done.
#pragma once

#include <functional>
#include <vector>

#include "experiment/design/trial_queue.h"
#include "experiment/ports.h"
#include "experiment/protocol/protocol.h"
#include "experiment/timing/refresh_ledger.h"
#include "experiment/trial.h"

namespace overt {

/// Everything a session talks to. All of it must outlive the session.
struct SessionPorts {
    Clock& clock;
    Presenter& presenter;
    EyeTracker& tracker;
    ResponsePanel& panel;
    SessionLog& log;
    std::vector<DisplayWitness*> witnesses;
};

struct SessionResult {
    int completed_trials = 0;
    bool aborted = false; ///< by the operator, or because the display or the tracker went away
    std::string reason;   ///< why, if aborted
    int missed_refreshes = 0;
    ValidationResult validation;
};

class Session {
  public:
    /// Told after each trial; `done` counts completed ones.
    using TrialDone = std::function<void(const Trial& trial, const TrialOutcome& outcome, int done)>;

    /// `protocol` and `schedule` must outlive the session.
    Session(const Protocol& protocol, const Schedule& schedule, const ScreenPoint& screen_centre,
            SessionPorts ports);

    /// Runs all trials in their order, with practice, breaks and repeated attempts as the protocol has them.
    /// An attempt that does not count is recorded as aborted. Throws DeviceError, GraphicsError or
    /// RecordError for what breaks between trials; what happens within one is in its outcome.
    SessionResult run(const TrialDone& trial_done);

  private:
    enum class Answer { pressed, timed_out, rejected, aborted };

    /// What an attempt was like besides its outcome.
    struct Attempt {
        TrialOutcome outcome;
        AttemptResult result;
    };
    void run_step(TrialQueue& queue, const SessionStep& step, SessionResult& result,
                  const TrialDone& trial_done);
    void run_practice(const SessionStep& step, const std::optional<Condition>& next);
    void run_break();
    Attempt run_trial(const Trial& trial, const std::optional<Condition>& next);
    void judge(TrialQueue& queue, const Trial& trial, Attempt& attempt);
    void present(const Trial& trial, Attempt& attempt);
    void check_drift(const Trial& trial, TrialOutcome& outcome);
    SessionTime show(const Screen& screen);
    Answer wait_for_press(SessionTime since, double min_s, double max_s, SessionTime& pressed_at);
    bool read_text(const std::string& text, double min_s);
    void take_samples(int trial) noexcept;
    void wait_and_take_samples(int trial, SessionTime until) noexcept;
    void read_clocks() noexcept;
    void note_disturbance(const Trial& trial, const Clock::Disturbance& before);
    bool went_away() const noexcept { return ports_.presenter.closed() || ports_.tracker.lost(); }

    const Protocol* protocol_;
    const Schedule* schedule_;
    ScreenPoint screen_centre_;
    SessionPorts ports_;
    PageCycle cycle_;
    RefreshLedger ledger_;
    SessionLog* log_;                                ///< the record; in practice, one that keeps events only
    std::vector<GazeSample> samples_;                ///< room for one poll
    std::int64_t sample_count_ = 0, lost_count_ = 0; ///< samples taken, and those without gaze
    bool aborted_ = false;
};

} // namespace overt
