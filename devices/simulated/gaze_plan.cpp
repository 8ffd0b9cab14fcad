#include "devices/simulated/gaze_plan.h"

#include <cmath>

#include "experiment/base/random.h"

namespace overt {

GazePlan gaze_plan(const ObservedScene& scene, std::uint64_t seed, int task, Stimulus stimulus) noexcept {
    GazePlan plan;
    double odds = 1.0;
    for (std::size_t i = 0; i < scene.effects.size(); ++i) {
        const ObservedEffect& effect = scene.effects[i];
        if (!effect.holds_in(task, stimulus))
            continue;
        odds *= effect.head_odds;
        plan.spread += effect.spread;
        if (effect.spot_share > 0.0 && plan.spot_count < most_simulated_spots)
            plan.spots[static_cast<std::size_t>(plan.spot_count++)] = {static_cast<int>(i),
                                                                       effect.spot_share};
    }
    if (scene.head_share_sd > 0.0)
        odds *= std::exp(scene.head_share_sd * RandomStream(seed, "inclination to heads").normal());
    const double share = scene.tasks[static_cast<std::size_t>(task)].head_share;
    // Shares of 0 and 1 are no odds, and stay what they are.
    plan.head_share = odds == 1.0 ? share : share * odds / (1.0 - share + share * odds);
    return plan;
}

} // namespace overt
