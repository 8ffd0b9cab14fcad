/// As observers of earlier sessions turned it: the poses of all of them are in Animation::given. Where their
/// tables could not be read, the object stands.
#include "experiment/animation.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::recorded>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex) -> Pose {
                                       return {{motion.angle}, {}};
                                   },
                                   .has_plan = false};
    return law;
}

} // namespace overt
