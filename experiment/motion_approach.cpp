/// Nearer along the line that the front looks along, as a sine from where it stands to the nearest place.
#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::approach>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        const double nearer = motion.approach * rise_of(motion, frame);
        return {{.angle = motion.angle, .tilt = ObjectPose{}.tilt, .shift = {0.0, 0.0 - nearer, 0.0}}, {}};
    }};
    return law;
}

} // namespace overt
