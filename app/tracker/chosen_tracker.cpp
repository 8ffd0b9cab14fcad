#include "app/tracker/chosen_tracker.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/protocol/entry_ids.h"

namespace overt {

Protocol with_one_tracker(const Protocol& protocol, const std::string& further_id) {
    if (further_id.empty()) {
        Protocol alone = protocol;
        alone.further_trackers.clear();
        return alone;
    }
    const auto& further = protocol.further_trackers;
    const auto found = std::ranges::find(further, further_id, &FurtherTrackerSettings::id);
    if (found == further.end())
        throw InputError(
            further.empty() ? fmt::format("--further {}: the protocol has no [[further_tracker]]", further_id)
                            : fmt::format("--further {}: the protocol's further trackers are {}", further_id,
                                          fmt::join(ids_of(further), ", ")));
    return protocol_of_further(protocol, static_cast<std::size_t>(found - further.begin()));
}

} // namespace overt
