#include <algorithm>
#include <iterator>

#include "experiment/protocol/design_settings.h"
#include "experiment/scene/areas.h"

namespace overt {

AreaShares simulated_shares(const Task& task) {
    AreaShares shares;
    const auto is_head = [](const auto& share) { return share.first == head_area; };
    const auto given = std::ranges::find_if(task.simulated_area_shares, is_head);
    const double usual = task.simulated_area_shares.empty() ? usual_head_share : 0.0;
    shares.emplace_back(head_area, given != task.simulated_area_shares.end()
                                       ? given->second
                                       : task.simulated_head_share.value_or(usual));
    std::ranges::copy_if(task.simulated_area_shares, std::back_inserter(shares),
                         [&](const auto& share) { return !is_head(share); });
    return shares;
}

} // namespace overt
