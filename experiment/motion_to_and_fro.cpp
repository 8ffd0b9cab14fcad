/// To and fro at one speed, with a rest at each end or none, and eased or not.
#include <algorithm>
#include <cmath>

#include "experiment/motion_phase.h"

namespace overt {

namespace {

/// From one end at -1 to the other at 1; `place` is that of a triangular wave, and rests beyond `reach`.
double eased(double place, double reach, MotionEase ease) {
    const double linear = std::clamp(place / reach, -1.0, 1.0);
    if (ease == MotionEase::none)
        return linear;
    // 2 (10 s^3 - 15 s^4 + 6 s^5) - 1 with s = (1 + u) / 2, written so that it is odd to the bit.
    const double square = linear * linear;
    return linear * (15.0 - square * (10.0 - 3.0 * square)) / 8.0;
}

template <bool rests> Pose to_and_fro(const Animation& motion, AnimationFrameIndex frame) {
    // A rest before and one behind each end: of the way from middle to end, in time, this share moves.
    const double reach = rests ? 1.0 - motion.rest_share : 1.0;
    return {turned(motion, motion.amplitude.value * eased(triangle_of(motion, frame), reach, motion.ease)),
            {}};
}

} // namespace

template <> const MotionLaw& motion_law<MotionKind::triangle>() {
    static constexpr MotionLaw law{.pose_of = to_and_fro<false>};
    return law;
}

template <> const MotionLaw& motion_law<MotionKind::trapezoid>() {
    static constexpr MotionLaw law{.pose_of = to_and_fro<true>};
    return law;
}

} // namespace overt
