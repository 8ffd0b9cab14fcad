/// The drift checks before a trial's animation.
#pragma once

#include <optional>
#include <string>

#include "experiment/session/operator_control.h"

namespace overt {

class DriftChecks {
  public:
    /// `state` and `control` must outlive this.
    DriftChecks(SessionState& state, OperatorControl& control, const ScreenPoint& screen_centre)
        : state_(state), control_(control), screen_centre_(screen_centre) {}

    /// Checks as often as the protocol says, and decides about the trial as it says. The drift that was
    /// measured last is in the outcome. A trial that is begun anew after a calibration goes on counting its
    /// checks.
    void check(TrialOutcome& outcome);
    /// When the first target of the last check() was lit.
    SessionTime began() const { return began_; }

  private:
    std::optional<std::string> failed_check(TrialOutcome& outcome);

    SessionState& state_;
    OperatorControl& control_;
    ScreenPoint screen_centre_;
    std::optional<int> checked_trial_; ///< whose checks are counted
    int failed_checks_ = 0;
    bool has_begun_ = false; ///< in this check()
    SessionTime began_;
};

} // namespace overt
