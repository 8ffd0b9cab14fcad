#include "devices/simulated/gaze_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiment/base/random.h"

namespace overt {

void favour_area(GazePlan& plan, const GazeFavour& favour) noexcept {
    const auto area = static_cast<std::size_t>(favour.area); // -1: beyond all
    double all = 1.0;
    for (std::size_t i = 0; i < plan.area_count; ++i)
        if (i == area)
            all = 1.0 - plan.shares[i] + plan.shares[i] * favour.odds;
    for (std::size_t i = 0; i < plan.area_count; ++i)
        plan.shares[i] *= (i == area ? favour.odds : 1.0) / all;
}

GazePlan gaze_plan(const ObservedScene& scene, std::uint64_t seed, int task, Stimulus stimulus) noexcept {
    GazePlan plan;
    plan.area_count = std::min(scene.areas.size(), most_observed_areas);
    std::array<double, most_observed_areas> odds;
    odds.fill(1.0);
    for (std::size_t i = 0; i < scene.effects.size(); ++i) {
        const ObservedEffect& effect = scene.effects[i];
        if (!effect.holds_in(task, stimulus))
            continue;
        odds[static_cast<std::size_t>(effect.area)] *= effect.odds;
        plan.spread += effect.spread;
        if (effect.spot_share > 0.0 && plan.spot_count < most_simulated_spots)
            plan.spots[static_cast<std::size_t>(plan.spot_count++)] = {static_cast<int>(i),
                                                                       effect.spot_share};
    }
    if (scene.share_sd > 0.0) {
        odds[0] *= std::exp(scene.share_sd * RandomStream(seed, "inclination to heads").normal());
        for (std::size_t area = 1; area < plan.area_count; ++area)
            odds[area] *=
                std::exp(scene.share_sd * RandomStream(seed, "inclination to an area", area).normal());
    }
    const std::vector<double>& shares = scene.tasks[static_cast<std::size_t>(task)].shares;
    double elsewhere = 1.0, multiplied = 0.0;
    bool is_changed = false;
    for (std::size_t area = 0; area < plan.area_count; ++area) {
        elsewhere -= shares[area];
        multiplied += shares[area] * odds[area];
        is_changed = is_changed || odds[area] != 1.0;
    }
    // What is rounded off sums must not become a share; and shares of 0 and 1 are no odds, and stay.
    elsewhere = std::max(elsewhere, 0.0);
    for (std::size_t area = 0; area < plan.area_count; ++area)
        plan.shares[area] = is_changed && elsewhere + multiplied > 0.0
                                ? shares[area] * odds[area] / (elsewhere + multiplied)
                                : shares[area];
    return plan;
}

} // namespace overt
