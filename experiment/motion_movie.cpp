/// Flat pictures, one after the other. Nothing moves: what tells the frames apart, where poses are told
/// apart, is the turn of a light that no picture shows, frame / frame_count of a full turn.
#include "experiment/animation.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::movie>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        return {{}, {360.0 * frame.value / motion.frame_count}};
    }};
    return law;
}

} // namespace overt
