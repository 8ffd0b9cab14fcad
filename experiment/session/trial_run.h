/// One attempt at a trial: question, drift check, animation, answer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/design/trial_queue.h"
#include "experiment/session/operator_control.h"
#include "experiment/timing/refresh_ledger.h"

namespace overt {

class TrialRun {
  public:
    /// Both must outlive this.
    TrialRun(SessionState& state, OperatorControl& control, const ScreenPoint& screen_centre);

    /// What an attempt was like.
    struct Attempt {
        TrialOutcome outcome; ///< status is aborted until the session has judged the attempt
        AttemptResult result;
    };
    /// `next`: the stimulus that probably comes after it. `is_practice`: its events are noted outside of
    /// trials, and no answer is recorded. Throws DeviceError, GraphicsError or RecordError for what breaks
    /// between its presentations; what happens in one is in the outcome.
    Attempt run(const Trial& trial, const std::optional<Condition>& next, bool is_practice);

  private:
    void ask(const Trial& trial, Attempt& attempt);
    void check_drift(TrialOutcome& outcome);
    void present(const Trial& trial, Attempt& attempt);
    void act_on_pressed_keys(Attempt& attempt);
    void take_answer(const Trial& trial, const std::optional<Condition>& next, bool is_practice,
                     Attempt& attempt);
    void keep_answer(AnswerRecording& recording);
    bool goes_on(const Attempt& attempt) const;
    void take_samples(int trial) noexcept;
    void wait_and_take_samples(int trial, SessionTime until) noexcept;
    void read_clocks() noexcept;
    void look_at_keys() noexcept;
    void note_disturbance(const Clock::Disturbance& before);

    SessionState& state_;
    OperatorControl& control_;
    ScreenPoint screen_centre_;
    PageCycle cycle_;
    RefreshLedger ledger_;
    std::vector<GazeSample> samples_;                ///< room for one poll
    std::int64_t sample_count_ = 0, lost_count_ = 0; ///< samples taken, and those without gaze
    std::optional<ResponsePress> pressed_;           ///< by the operator during a presentation, the first
};

} // namespace overt
