/// The observer fills in a part of the form on the screen.
#pragma once

#include <string>

#include "experiment/ports/observer_field.h"
#include "experiment/session/operator_control.h"

namespace overt {

/// Asks for the fields of this moment (ObserverFieldSettings::when), shows them where somebody can type and
/// something is still empty, and records what stands there with the time. `values`: of all fields of the
/// protocol, in their order; what is filled in goes there. Nothing happens where no field is asked then.
/// False: the session is over.
bool fill_in_form(SessionState& state, OperatorControl& control, FieldValues& values,
                  const std::string& when);

} // namespace overt
