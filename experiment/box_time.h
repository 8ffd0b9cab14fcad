/// The clock of a display box, and the way from it to the session's.
#pragma once

#include <chrono>
#include <cstdint>

#include "experiment/clock_map.h"
#include "experiment/clock_pair.h"
#include "experiment/session_time.h"

namespace overt {

/// The clock of a Display++ or Bits#: seconds with six decimals in its status lines, so counted in
/// microseconds. Zero at power-up and at a clock reset.
struct BoxClock {
    using rep = std::int64_t;
    using period = std::micro;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<BoxClock>;
    static constexpr bool is_steady = true;
};
using BoxTime = BoxClock::time_point;
static_assert(!Subtractable<SessionTime, BoxTime> && !Subtractable<TrackerTime, BoxTime>,
              "two machines' clocks must not be mixed");

/// Seconds since the box's clock was last zero.
constexpr double to_seconds(BoxTime time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

using BoxClockPair = ClockPairOf<BoxClock>;
using BoxClockMap = ClockMapOf<BoxClock>;

} // namespace overt
