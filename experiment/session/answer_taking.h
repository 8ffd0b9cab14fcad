/// The response screen: the observer's answer, by a key or a box, and by voice.
#pragma once

#include "experiment/session/operator_control.h"

namespace overt {

class AnswerTaking {
  public:
    /// Both must outlive this.
    AnswerTaking(SessionState& state, OperatorControl& control) : state_(state), control_(control) {}

    /// Shows the trial's response screen until it is answered or its time is up, which is `limit_s`, or the
    /// protocol's where that is nothing. `next`: whose frames are loaded meanwhile. In practice no voice is
    /// recorded. Gives how it ended.
    OperatorControl::How take(const Trial& trial, const std::optional<Trial>& next, bool is_practice,
                              std::optional<double> limit_s, TrialOutcome& outcome);

  private:
    void keep(AnswerRecording& recording);

    SessionState& state_;
    OperatorControl& control_;
};

} // namespace overt
