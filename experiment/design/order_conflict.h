/// Why the trials of an observer cannot be ordered, in the protocol's words.
#pragma once

#include <optional>

#include "experiment/design/block_plan.h"
#include "experiment/design/schedule.h"

namespace overt {

/// Nothing if there is an order.
std::optional<OrderConflict> conflict_in(const Protocol& protocol, const OrderChain& chain);

} // namespace overt
