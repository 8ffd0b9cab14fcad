#include "experiment/record/asc/asc_stamps.h"

#include <chrono>

namespace overt {

std::optional<TrackerTime> AscStamps::next(std::int64_t us, double rate_hz) {
    const TrackerTime time{TrackerClock::duration(us)};
    if (time != last_) {
        last_ = time;
        repeats_ = 0;
        return time;
    }
    ++repeats_;
    const auto interval_us = static_cast<std::int64_t>(1e6 / (rate_hz > 0.0 ? rate_hz : 2000.0));
    const auto later = TrackerClock::duration(interval_us * repeats_);
    return later < std::chrono::milliseconds(1) ? std::optional(time + later) : std::nullopt;
}

} // namespace overt
