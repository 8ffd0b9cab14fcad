/// Times of trackers that tell them in seconds.
#pragma once

#include <cmath>
#include <optional>

#include "experiment/session_time.h"

namespace overt {

/// To the nearest microsecond. Nothing for what is no time: not finite, or further from the clock's zero than
/// 126 years, so that it can be counted in nanoseconds, too.
inline std::optional<TrackerTime> tracker_time_of_seconds(double seconds) noexcept {
    constexpr double latest_s = 4e9;
    if (!(std::abs(seconds) < latest_s))
        return std::nullopt;
    return tracker_time(std::llround(seconds * 1e6));
}

/// What tracker_time_of_seconds() was made from.
constexpr double to_seconds(TrackerTime time) noexcept {
    return static_cast<double>(time.time_since_epoch().count()) * 1e-6;
}

} // namespace overt
