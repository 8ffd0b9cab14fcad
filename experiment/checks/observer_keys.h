/// Keys that observers press, by their names in protocols.
#pragma once

#include <string>
#include <string_view>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Why the observer cannot have a key, with what would help; empty: it can. Buttons of response boxes are
/// called as their box calls them, which is known once it is there.
struct KeyFault {
    std::string message, hint;
};
KeyFault fault_of_observer_key(const Protocol& protocol, std::string_view key);

} // namespace overt
