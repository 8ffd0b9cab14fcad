/// On which screen a key was pressed that a response panel sees.
#pragma once

#include <optional>

#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"

namespace overt {

/// Whether the observer's key that goes on does anything there: a stimulus waits for nobody.
constexpr bool goes_on_at(SessionPhase screen) {
    return screen != SessionPhase::stimulus && screen != SessionPhase::trial;
}

/// A panel tells it what it is told itself. Keys that it sees before it has taken up a new wait were pressed
/// on the screen before: the new one was not lit yet.
class PressedOn {
  public:
    void entered(SessionPhase phase, int trial) noexcept {
        trial_ = trial;
        next_ = phase;
        if (phase != SessionPhase::task_screen && phase != SessionPhase::response_screen)
            waits_for(Awaited::key);
    }
    /// After what was pressed before has been taken.
    void waits_for(Awaited what) noexcept {
        now_ = next_;
        is_observers_ = what == Awaited::key || what == Awaited::response || what == Awaited::answer;
    }

    /// The screen, where keys are recorded: in trials and between them, but not where a form is filled in,
    /// the operator decides, or a tracker is set up.
    std::optional<SessionPhase> screen() const noexcept {
        const bool is_operators = now_ == SessionPhase::set_up || now_ == SessionPhase::calibration ||
                                  now_ == SessionPhase::drift_check || now_ == SessionPhase::pause;
        return is_observers_ && !is_operators ? std::optional(now_) : std::nullopt;
    }
    int trial() const noexcept { return trial_; } ///< -1 in practice, and outside of trials

  private:
    SessionPhase now_ = SessionPhase::set_up, next_ = SessionPhase::set_up;
    bool is_observers_ = true;
    int trial_ = -1;
};

} // namespace overt
