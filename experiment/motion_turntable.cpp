/// All the way round at one speed: 360 turns k / (n-1) degrees.
#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::turntable>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        ObjectPose object = turned(motion, full_turns_of(motion, frame, motion.turns));
        object.angle.value = within_half_turn(object.angle.value);
        return {object, {}};
    }};
    return law;
}

} // namespace overt
