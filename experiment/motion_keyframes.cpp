/// By a table: what it says is in Animation::given. Where it could not be read, the object stands.
#include "experiment/animation.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::keyframes>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex) -> Pose {
        return {{motion.angle}, {}};
    }};
    return law;
}

} // namespace overt
