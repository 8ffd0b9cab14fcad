/// The display box's own clock, and the way from it to the session's.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "experiment/clock_map.h"
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

/// One reading of both clocks: the box's time was taken at some instant between the two readings of the
/// session clock.
struct BoxClockPair {
    SessionTime before;
    BoxTime box;
    SessionTime after;
};

/// Maps box time to session time as ClockMap does for a tracker: the same line through the pairs, the same
/// bound on its error. Pairs must come from one run of the box's clock, none from before a reset.
class BoxClockMap {
  public:
    /// At least one pair, in any order.
    explicit BoxClockMap(std::span<const BoxClockPair> pairs);

    MappedTime to_session(BoxTime time) const;

    /// By how much a second of the session clock exceeds a second of the box's, in millionths.
    double drift_ppm() const { return map_.drift_ppm(); }

    /// Bound on the error of drift_ppm().
    double drift_uncertainty_ppm() const { return map_.drift_uncertainty_ppm(); }

  private:
    ClockMap map_; ///< with the box in the tracker's place: both count microseconds
};

} // namespace overt
