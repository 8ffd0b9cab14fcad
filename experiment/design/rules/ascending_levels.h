/// What the rules of difference scaling have in common: stimuli in the order of one factor's levels.
#pragma once

#include <vector>

#include "experiment/design/rules/trial_rule.h"

namespace overt {

/// All sets of `size` stimuli of a context whose levels of the first factor rise from one to the next.
inline Combinations ascending_sets(const RuleRequest& request, std::size_t size) {
    Combinations all(size);
    const std::vector<int>& levels = request.of.front().of_stimulus;
    for (const std::vector<int>& stimuli : stimuli_by_context(request)) {
        std::vector<int> set;
        const auto extend = [&](const auto& again, std::size_t from) -> void {
            if (set.size() == size) {
                all.add(set);
                return;
            }
            for (std::size_t i = from; i < stimuli.size() && !all.is_full(); ++i) {
                const int level = levels[static_cast<std::size_t>(stimuli[i])];
                if (level < 0 || (!set.empty() && level <= levels[static_cast<std::size_t>(set.back())]))
                    continue;
                set.push_back(stimuli[i]);
                again(again, i + 1);
                set.pop_back();
            }
        };
        extend(extend, 0);
    }
    return all;
}

} // namespace overt
