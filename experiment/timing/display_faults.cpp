#include "experiment/timing/display_faults.h"

#include <algorithm>

#include "experiment/base/random.h"

namespace overt {

bool DisplayFaults::is_clean() const {
    return drift_ppm == 0.0 && jitter_sd_ms == 0.0 && counts_refreshes && given.empty() &&
           by_chance.are_none();
}

namespace {

void draw_faults(const RandomFaults& by_chance, std::uint64_t seed, int trial, int refreshes,
                 std::vector<DisplayFault>& into) {
    RandomStream random(seed, "display faults", static_cast<std::uint64_t>(trial));
    using Kind = DisplayFault::Kind;
    for (int refresh = 0; refresh < refreshes; ++refresh) {
        // Always as many numbers, so that one share changes nothing of the other kinds.
        const double late = random.uniform(), skip = random.uniform(), stall = random.uniform();
        const double late_ms = random.uniform(by_chance.late_min_ms, by_chance.late_max_ms);
        const double stall_ms = random.uniform(by_chance.stall_min_ms, by_chance.stall_max_ms);
        const auto skipped = static_cast<int>(
            random.below(static_cast<std::uint32_t>(std::max(by_chance.skip_max_refreshes, 1))));
        if (stall < by_chance.stall_share && refresh > 0)
            into.push_back({Kind::stall, trial, refresh, stall_ms});
        if (late < by_chance.late_share)
            into.push_back({Kind::late, trial, refresh, late_ms});
        if (skip < by_chance.skip_share)
            into.push_back({Kind::skip, trial, refresh, 0.0, 1 + skipped});
    }
}

} // namespace

std::vector<DisplayFault> faults_in(const DisplayFaults& faults, int trial, int refreshes) {
    std::vector<DisplayFault> all;
    for (const DisplayFault& fault : faults.given) {
        if (fault.trial.value_or(trial) == trial)
            all.push_back(fault);
    }
    if (!faults.by_chance.are_none())
        draw_faults(faults.by_chance, faults.seed, trial, refreshes, all);
    std::stable_sort(all.begin(), all.end(),
                     [](const DisplayFault& a, const DisplayFault& b) { return a.refresh < b.refresh; });
    return all;
}

} // namespace overt
