/// Where in its way a motion is in a frame. The symmetries are applied to whole numbers first, so that frames
/// at the same place get bit-identical numbers, and there is no negative zero.
#pragma once

#include "experiment/animation.h"

namespace overt {

/// Of a motion to and fro: sin(2 pi k / (n-1)) with cycle and -cos(pi k / (n-1)) with ping_pong, for frame k
/// of n.
double sine_of(const Animation& motion, AnimationFrameIndex frame);

/// The same place of a triangular wave, whose ends are at -1 and 1 as those of the sine.
double triangle_of(const Animation& motion, AnimationFrameIndex frame);

/// From 0 to 1 and back with cycle, from 0 to 1 with ping_pong: sin^2(pi k / (n-1)), sin^2(pi k / 2(n-1)).
double rise_of(const Animation& motion, AnimationFrameIndex frame);

/// Degrees that are turned up to a frame at one speed, of so many whole turns in all frames; within half a
/// turn.
double full_turns_of(const Animation& motion, AnimationFrameIndex frame, int turns);

/// The same turn from -180 (not included) to 180 degrees.
double within_half_turn(double angle_deg);

/// A motion about its axis and pivot, which has turned by so much.
inline ObjectPose turned(const Animation& motion, double by_deg) {
    return turned_about(motion.axis.value_or(glm::dvec3(0.0, 0.0, 1.0)),
                        motion.pivot.value_or(glm::dvec3(0.0)), {by_deg}, motion.angle);
}

} // namespace overt
