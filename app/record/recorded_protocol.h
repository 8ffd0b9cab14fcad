/// The protocol of a recorded session, from its own text alone.
#pragma once

#include <optional>

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol.h"
#include "experiment/record/session_header.h"

namespace overt {

/// Nothing, and why, if this version of the program cannot use it. Files that it names are not looked at.
std::optional<Protocol> recorded_protocol(const SessionHeader& header, Diagnostics& diagnostics);

} // namespace overt
