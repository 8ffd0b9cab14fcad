/// A sum of sines: each a sin(2 pi p k / (n-1) + phase) with p whole periods in all frames.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::waves>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        const int intervals = std::max(motion.frame_count - 1, 1);
        double sum_deg = 0.0;
        for (const auto& [amplitude_deg, periods, phase_deg] : motion.waves) {
            // The whole turns left out, so that the last frame is the first to the bit.
            const double share = std::fmod(periods * frame.value, intervals) / intervals;
            sum_deg += amplitude_deg * std::sin(2.0 * std::numbers::pi * (share + phase_deg / 360.0));
        }
        return {turned(motion, sum_deg), {}};
    }};
    return law;
}

} // namespace overt
