/// Whether the observer will be able to read what the protocol has for them.
#pragma once

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Warns of texts with characters that no font of this machine has, and of those that are set smaller than
/// the protocol says because they would not fit the screen. Errors for texts that are not UTF-8.
void check_texts(const Protocol& protocol, Diagnostics& diagnostics);

} // namespace overt
