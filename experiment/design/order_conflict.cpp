#include "experiment/design/order_conflict.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/design/observer_groups.h"
#include "experiment/design/orders/order_draw.h"

namespace overt {

namespace {

/// "runs of 2 with the same object", "a distance of 3 between trials with the same material".
std::string described(const OrderLimit& limit) {
    return limit.kind == OrderLimit::Kind::longest_run
               ? fmt::format("runs of {} with the same {}", limit.amount, limit.noun)
               : fmt::format("a distance of {} between trials with the same {}", limit.amount, limit.noun);
}

std::string where(const Protocol& protocol, const OrderChain& chain) {
    std::vector<std::string> ids;
    for (const BlockPlan& plan : chain.blocks) {
        if (!protocol.blocks.empty())
            ids.push_back(block_at(protocol, plan.block).id);
    }
    return ids.empty()       ? ""
           : ids.size() == 1 ? fmt::format(" in block \"{}\"", ids.front())
                             : fmt::format(" in blocks \"{}\"", fmt::join(ids, "\", \""));
}

/// The level that is hardest to place: ": one object has 9 of the 12 trials".
std::string most_frequent(const OrderChain& chain, const OrderLimit& limit) {
    if (chain.problem.parts.size() != 1 || chain.problem.parts.front().segments.size() != 1 ||
        chain.problem.parts.front().segments.front().is_drawn())
        return "";
    std::map<int, int> counts;
    for (const int level : chain.problem.levels[static_cast<std::size_t>(limit.factor)])
        ++counts[level];
    int most = 0;
    for (const auto& [level, count] : counts)
        most = std::max(most, count);
    return fmt::format(": one {} has {} of the {} trials", limit.noun, most, chain.trials.size());
}

std::string hint_for(const OrderChain& chain, const OrderLimit& limit) {
    const int nearest = nearest_possible_amount(chain.problem, limit);
    if (nearest == 0)
        return "take the limit out";
    return limit.kind == OrderLimit::Kind::longest_run
               ? fmt::format("allow runs of {} at least, or 0 for no limit", nearest)
               : fmt::format("a distance of {} is the most that can be kept, 0 is no limit", nearest);
}

} // namespace

std::optional<OrderConflict> conflict_in(const Protocol& protocol, const OrderChain& chain) {
    const std::optional<LimitConflict> found = find_limit_conflict(chain.problem);
    if (!found)
        return std::nullopt;
    OrderConflict conflict;
    std::vector<std::string> limits;
    for (const OrderLimit& limit : found->limits) {
        if (std::find(conflict.keys.begin(), conflict.keys.end(), limit.key) != conflict.keys.end())
            continue;
        conflict.keys.push_back(limit.key);
        limits.push_back(described(limit));
    }
    if (!found->is_proved) {
        conflict.message = fmt::format(
            "no order was found{} that keeps to {}; there may be one, which {} places of a search "
            "did not come to",
            where(protocol, chain), fmt::join(limits, " and to "), OrderDraw::most_searched_states);
        conflict.hint = "loosen one of the limits";
    } else if (found->limits.size() == 1) {
        conflict.message = fmt::format("no order keeps to {}{}{}", limits.front(), where(protocol, chain),
                                       most_frequent(chain, found->limits.front()));
        conflict.hint = hint_for(chain, found->limits.front());
    } else {
        conflict.message =
            fmt::format("no order keeps to {}{} together; without any one of them there is one",
                        fmt::join(limits, " and to "), where(protocol, chain));
        conflict.hint = fmt::format("loosen {}", fmt::join(conflict.keys, " or "));
    }
    return conflict;
}

std::optional<OrderConflict> find_order_conflict(const Protocol& protocol) {
    int observers = protocol.schedule.observers;
    if (const auto capacity = group_capacity(protocol))
        observers = std::min(observers, *capacity);
    std::vector<OrderProblem> sound;
    for (int number = 1; number <= observers; ++number) {
        for (const OrderChain& chain : order_chains(protocol, number, 0)) {
            if (chain.problem.limits.empty() ||
                std::find(sound.begin(), sound.end(), chain.problem) != sound.end())
                continue;
            if (auto conflict = conflict_in(protocol, chain)) {
                if (number > 1)
                    conflict->message += fmt::format(" (observer {})", number);
                return conflict;
            }
            if (sound.size() < 256)
                sound.push_back(chain.problem);
        }
    }
    return std::nullopt;
}

} // namespace overt
