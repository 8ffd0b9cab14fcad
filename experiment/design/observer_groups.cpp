#include "experiment/design/observer_groups.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

std::optional<int> group_capacity(const Protocol& protocol) {
    int all = 0;
    for (const GroupSettings& group : protocol.groups) {
        if (group.cap == 0)
            return std::nullopt;
        all += group.cap;
    }
    return protocol.groups.empty() ? std::nullopt : std::optional(all);
}

GroupPlace group_place(const Protocol& protocol, int observer_number) {
    OVERT_EXPECTS(observer_number >= 1);
    if (protocol.groups.empty())
        return {-1, observer_number - 1};
    const std::optional<int> capacity = group_capacity(protocol);
    if (capacity && observer_number > *capacity) {
        std::string caps;
        for (const GroupSettings& group : protocol.groups)
            caps += fmt::format("{}{} {}", caps.empty() ? "" : ", ", group.id, group.cap);
        throw InputError(
            fmt::format("observer number {} is beyond the caps of the groups, which take {} ({}): "
                        "raise a [[group]]'s cap, or take a number that is still free",
                        observer_number, *capacity, caps));
    }
    // In whole steps: for as many rounds as the smallest group that is still open takes.
    int before = 0, round = 0;
    while (true) {
        std::vector<int> open;
        int rounds = observer_number; // enough for all that are left
        for (int group = 0; group < static_cast<int>(protocol.groups.size()); ++group) {
            const int cap = protocol.groups[static_cast<std::size_t>(group)].cap;
            if (cap != 0 && cap <= round)
                continue;
            open.push_back(group);
            if (cap != 0)
                rounds = std::min(rounds, cap - round);
        }
        const int width = static_cast<int>(open.size());
        const int left = observer_number - 1 - before;
        if (left < static_cast<long long>(rounds) * width)
            return {open[static_cast<std::size_t>(left % width)], round + left / width};
        before += rounds * width;
        round += rounds;
    }
}

} // namespace overt
