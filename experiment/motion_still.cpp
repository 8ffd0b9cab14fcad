/// It stands at its angle.
#include "experiment/animation.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::still>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex) -> Pose {
                                       return {{motion.angle}, {}};
                                   },
                                   .moves = false};
    return law;
}

} // namespace overt
