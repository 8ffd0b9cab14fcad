/// The operator's view in a terminal.
#pragma once

#include "devices/operator/operator_client.h"

namespace overt {

/// Until the session is over, the input ends or the operator types "leave"; gives the exit code. Where output
/// is no terminal: a line for each change of phase or trial. Commands are typed, a line each, and asked about
/// before they are sent.
int watch_in_terminal(OperatorClient& client);

/// The figures as text, once.
void print_once(OperatorClient& client);

} // namespace overt
