/// What a session of a protocol opens on the machine besides its screen: libraries, addresses in the network,
/// ports and devices, and files outside of the protocol's folder. A protocol may come from another lab; this
/// is what to read before it runs (docs/trust.md).
#pragma once

#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

struct OpenedThing {
    std::string kind;  ///< "library", "device or address", "sound", "file outside" …
    std::string whose; ///< what of the protocol wants it, such as `[tracker]` or `[[marker_output]] "eeg"`
    std::string what;  ///< which one
    bool operator==(const OpenedThing&) const = default;
};

/// In the order of the protocol's sections; libraries of makers by where they come from in this process's
/// environment. `protocol` as read_protocol() gives it. Opens nothing itself.
std::vector<OpenedThing> opened_by(const Protocol& protocol);

/// A heading and a line for each; says so where there is nothing.
std::string to_text(const std::vector<OpenedThing>& opened);

} // namespace overt
