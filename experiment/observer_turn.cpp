#include "experiment/observer_turn.h"

#include <algorithm>
#include <cmath>

namespace overt {

int ObserverTurn::turn_count() const {
    const int steps = static_cast<int>(std::lround((to.value - from.value) / step.value));
    return is_whole() ? std::max(1, steps) : std::max(0, steps) + 1;
}

int ObserverTurn::elevation_count() const {
    if (!has_elevations())
        return 1;
    const double range_deg = elevation_to.value - elevation_from.value;
    return std::max(0, static_cast<int>(std::lround(range_deg / elevation_step.value))) + 1;
}

Degrees ObserverTurn::elevation_of(int pose) const {
    return {has_elevations() ? elevation_from.value + elevation_step.value * (pose / turn_count()) : 0.0};
}

ObjectPose ObserverTurn::pose_of(int pose) const {
    return turned_and_tilted(angle_of(pose), elevation_of(pose));
}

int ObserverTurn::nearest(Degrees angle, Degrees elevation) const {
    const int turns = turn_count();
    double turn_deg = angle.value - from.value;
    if (is_whole())
        turn_deg -= 360.0 * std::floor(turn_deg / 360.0);
    const int nearest_turn = static_cast<int>(std::lround(turn_deg / step.value));
    const int turn = is_whole() ? nearest_turn % turns : std::clamp(nearest_turn, 0, turns - 1);
    if (!has_elevations())
        return turn;
    const double steps = (elevation.value - elevation_from.value) / elevation_step.value;
    return turn + turns * std::clamp(static_cast<int>(std::lround(steps)), 0, elevation_count() - 1);
}

Degrees elevation_of(const ObjectPose& pose) {
    return to_degrees({2.0 * std::atan2(pose.tilt.x, pose.tilt.w)});
}

ObjectPose turned_and_tilted(Degrees angle, Degrees elevation) {
    // A turn alone stays what it is to the last bit.
    return elevation.value == 0.0 ? ObjectPose{angle}
                                  : turned_about({1.0, 0.0, 0.0}, glm::dvec3(0.0), elevation, angle);
}

} // namespace overt
