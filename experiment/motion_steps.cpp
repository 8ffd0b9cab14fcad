/// At one angle after the other, each for the same number of frames.
#include <algorithm>

#include "experiment/motion_phase.h"

namespace overt {

template <> const MotionLaw& motion_law<MotionKind::steps>() {
    static constexpr MotionLaw law{.pose_of = [](const Animation& motion, AnimationFrameIndex frame) -> Pose {
        const int count = static_cast<int>(motion.angles_deg.size());
        if (count == 0)
            return {{motion.angle}, {}};
        int number = frame.value * count / std::max(motion.frame_count - 1, 1);
        // The last frame closes the loop, or ends the way.
        if (number >= count)
            number = motion.playback == Playback::cycle ? 0 : count - 1;
        return {turned(motion, motion.angles_deg[static_cast<std::size_t>(number)]), {}};
    }};
    return law;
}

} // namespace overt
