/// What comes before the first trial: consent, the observer's form, the welcome and the instructions.
#pragma once

#include "experiment/session/operator_control.h"

namespace overt {

class SessionOpening {
  public:
    /// All must outlive this. `fields`: what of the form is filled in already, and then.
    SessionOpening(SessionState& state, OperatorControl& control, FieldValues& fields)
        : state_(state), control_(control), fields_(fields) {}

    /// Until calibration may begin, or the session is over. Of an observer who declines nothing else is
    /// recorded. `is_known`: consent and form are in the record already.
    void run(bool is_known);

  private:
    bool ask_for_consent();
    void read_instructions();

    SessionState& state_;
    OperatorControl& control_;
    FieldValues& fields_;
};

/// Shows a text until a key is pressed, however long that takes, and notes `what` it was; nothing where the
/// text is empty. Whether things go on.
bool read_text(SessionState& state, OperatorControl& control, const std::string& text, std::string what);

} // namespace overt
