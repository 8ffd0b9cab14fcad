#include "experiment/record/read/shown_levels.h"

#include <algorithm>

namespace overt {

ShownLevels::ShownLevels(const SessionRecord& record, const TrialRecord& seen) : own_(seen.trial.stimulus) {
    const std::vector<MatchLevel>* levels = nullptr;
    for (const GivenAnswer& given : seen.outcome.given)
        if (given.slot == seen.trial.slot && !given.levels.empty())
            levels = &given.levels;
    if (!levels)
        return;
    const std::vector<FlipRecord> flips = record.flips(seen);
    auto flip = flips.begin();
    for (const SteeredFlip& moved : record.steered_flips(seen)) {
        flip = std::ranges::find(flip, flips.end(), moved.refresh_in_trial, &FlipRecord::refresh_in_trial);
        if (flip == flips.end())
            return;
        if (const auto level = std::ranges::find(*levels, moved.level, &MatchLevel::level);
            level != levels->end())
            set_[flip->report.refresh.value] = level->stimulus;
    }
}

const Stimulus& ShownLevels::at(RefreshIndex refresh) const {
    const auto found = set_.find(refresh.value);
    return found == set_.end() ? own_ : found->second;
}

} // namespace overt
