/// The camera goes about the vertical through the object's centre, counter-clockwise seen from above. Object
/// and light go the other way in front of a camera that stays, which gives the same pictures and the same
/// maps.
#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::orbit>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        const double back = within_half_turn(-full_turns_of(motion, frame, motion.turns));
        return {{{within_half_turn(motion.angle.value + back)}}, {back}};
    }};
    return law;
}

} // namespace overt
