/// Which of a protocol's eye trackers a command is about.
#pragma once

#include <string>

#include "experiment/protocol/protocol.h"

namespace overt {

/// The protocol with this tracker as its only one: that of [tracker], or the further one of this id. Throws
/// InputError naming those there are.
Protocol with_one_tracker(const Protocol& protocol, const std::string& further_id);

} // namespace overt
