/// As the observer turns it: the frames are the poses, and a step shows one after the other until it is known
/// which.
#include "experiment/animation.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::observer>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
                                       return {motion.by_observer.pose_of(frame.value), {}};
                                   },
                                   .has_plan = false};
    return law;
}

} // namespace overt
