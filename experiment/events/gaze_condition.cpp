#include "experiment/events/gaze_condition.h"

namespace overt {

bool GazeCondition::take(const WatchedSample& sample) noexcept {
    if (is_true())
        return true;
    if (!sample.has_gaze) {
        if (begin_ && sample.at - last_inside_ > settings_.longest_blink)
            begin_.reset();
        return false;
    }
    if (!sample.is_inside) {
        begin_.reset();
        return false;
    }
    const TrackerClock::duration since = sample.at - last_inside_;
    // A sample may come half an interval late or early before one is lacking.
    const bool is_next = 2 * since <= 3 * settings_.interval;
    if (begin_ && (is_next || since <= settings_.longest_blink)) {
        if (is_next)
            counted_ += since;
    } else {
        begin_ = sample.at;
        counted_ = {};
    }
    last_inside_ = sample.at;
    if (counted_ >= settings_.piece)
        detected_ = sample.at;
    return is_true();
}

} // namespace overt
