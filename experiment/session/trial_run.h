/// One attempt at a trial: question, drift check, animation, answer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/design/trial_queue.h"
#include "experiment/session/answer_taking.h"
#include "experiment/session/drift_checks.h"
#include "experiment/session/tracker_feed.h"
#include "experiment/timing/refresh_ledger.h"
#include "experiment/timing/slot_cycles.h"

namespace overt {

class TrialRun {
  public:
    /// `state` and `control` must outlive this.
    TrialRun(SessionState& state, OperatorControl& control, const ScreenPoint& screen_centre);

    /// What an attempt was like.
    struct Attempt {
        TrialOutcome outcome; ///< status is aborted until the session has judged the attempt
        AttemptResult result;
    };
    /// `next`: what probably comes after it. `is_practice`: its events are noted outside of
    /// trials, and no answer is recorded. Throws GraphicsError or RecordError for what breaks between its
    /// presentations; what happens in one, or to the tracker, is in the outcome.
    Attempt run(const Trial& trial, const std::optional<Trial>& next, bool is_practice);

  private:
    void ask(const Trial& trial, Attempt& attempt);
    void start_recording();
    void note_what_came(Attempt& attempt);
    void act_on_tracker(Attempt& attempt);
    void note_lost_trackers();
    void present(const Trial& trial, Attempt& attempt);
    void act_on_pressed_keys(Attempt& attempt);
    bool goes_on(const Attempt& attempt) const;
    void take_items(int trial) noexcept;
    void wait_and_take_items(int trial, SessionTime until) noexcept;
    void read_clocks() noexcept;
    void look_at_keys() noexcept;
    /// To the trackers and to the outputs of markers.
    void mark(MarkedEvent event, SessionTime at, std::string_view text) noexcept;
    void mark_trackers(SessionTime at, std::string_view text) noexcept;
    void mark_flip(const FlipRecord& flip) noexcept;
    void mark_result(const Trial& trial, const Attempt& attempt);
    void note_disturbance(const Clock::Disturbance& before);

    SessionState& state_;
    OperatorControl& control_;
    DriftChecks drift_checks_;
    AnswerTaking answers_;
    std::vector<PageCycle> cycles_; ///< by motion
    RefreshLedger ledger_;
    SlotCycles slots_;
    /// Of one tracker of the session.
    struct Feed {
        UsedTracker& used;
        TrackerFeed items;
    };
    std::vector<Feed> feeds_;                     ///< of all trackers, the session's own first
    std::optional<ResponsePress> pressed_;        ///< by the operator during a presentation, the first
    AnimationFrameIndex marked_frame_ = no_frame; ///< the last whose flip the trackers were told of
};

} // namespace overt
