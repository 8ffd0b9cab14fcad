#include "experiment/object_pose.h"

#include <glm/gtc/quaternion.hpp>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Of unit length and with w >= 0: of the two that mean one rotation always the same, without negative zeros.
glm::dquat settled(glm::dquat rotation) {
    rotation = glm::normalize(rotation);
    const bool is_half_turn = rotation.w == 0.0;
    const double sign = !is_half_turn       ? rotation.w
                        : rotation.z != 0.0 ? rotation.z
                        : rotation.y != 0.0 ? rotation.y
                                            : rotation.x;
    if (sign < 0.0)
        rotation = -rotation;
    for (int i = 0; i < 4; ++i)
        rotation[i] += 0.0;
    return rotation;
}

} // namespace

ObjectPose turned_about(glm::dvec3 axis, glm::dvec3 pivot, Degrees angle, Degrees before) {
    // Protocols with such an axis are refused, but what else is wrong with them is told, too.
    if (!(glm::length(axis) > 0.0))
        return {before};
    axis = glm::normalize(axis);
    const bool is_vertical = axis.x == 0.0 && axis.y == 0.0;
    const double signed_angle = is_vertical && axis.z < 0.0 ? -angle.value : angle.value;
    if (is_vertical && pivot.x == 0.0 && pivot.y == 0.0)
        return {{before.value + signed_angle}};
    const glm::dquat rotation = glm::angleAxis(to_radians(angle).value, axis);
    // What turns about the pivot turns about the centre, which the turn carries along.
    const glm::dvec3 shift = angle.value == 0.0 ? glm::dvec3(0.0) : pivot - rotation * pivot;
    if (is_vertical)
        return {.angle = {before.value + signed_angle}, .tilt = ObjectPose{}.tilt, .shift = shift};
    return {.angle = before, .tilt = settled(rotation), .shift = shift};
}

ObjectPose between(const ObjectPose& from, const ObjectPose& to, double share) {
    if (share == 0.0)
        return from;
    double turn = to.angle.value - from.angle.value;
    if (std::abs(turn) > 180.0)
        turn = std::remainder(turn, 360.0);
    ObjectPose pose{{from.angle.value + share * turn}};
    if (from.is_turn() && to.is_turn())
        return pose;
    pose.tilt = settled(glm::slerp(from.tilt, to.tilt, share));
    pose.shift = from.shift + share * (to.shift - from.shift);
    return pose;
}

ObjectPose object_pose_of(glm::dquat rotation, glm::dvec3 shift) {
    OVERT_EXPECTS(glm::length(rotation) > 0.0);
    rotation = settled(rotation);
    if (rotation.x != 0.0 || rotation.y != 0.0)
        return {.angle = {}, .tilt = rotation, .shift = shift};
    return {.angle = to_degrees({2.0 * std::atan2(rotation.z, rotation.w)}),
            .tilt = ObjectPose{}.tilt,
            .shift = shift};
}

} // namespace overt
