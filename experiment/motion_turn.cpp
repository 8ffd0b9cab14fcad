/// To and fro as a sine: a sin(2 pi k / (n-1)) with cycle, -a cos(pi k / (n-1)) with ping_pong.
#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::turn>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        return {turned(motion, motion.amplitude.value * sine_of(motion, frame)), {}};
    }};
    return law;
}

} // namespace overt
