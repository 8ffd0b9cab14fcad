#include "experiment/observer_turn.h"

#include <algorithm>
#include <cmath>

namespace overt {

int ObserverTurn::pose_count() const {
    const int steps = static_cast<int>(std::lround((to.value - from.value) / step.value));
    return is_whole() ? std::max(1, steps) : std::max(0, steps) + 1;
}

int ObserverTurn::nearest(Degrees angle) const {
    const int count = pose_count();
    double turn = angle.value - from.value;
    if (is_whole())
        turn -= 360.0 * std::floor(turn / 360.0);
    const int pose = static_cast<int>(std::lround(turn / step.value));
    return is_whole() ? pose % count : std::clamp(pose, 0, count - 1);
}

} // namespace overt
