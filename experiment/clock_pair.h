/// Readings of the session clock together with the clock of another machine.
#pragma once

#include "experiment/session_time.h"

namespace overt {

/// One reading of both clocks: the other machine's time was taken at some instant between the two readings of
/// the session clock.
template <class OtherClock> struct ClockPairOf {
    SessionTime before;
    typename OtherClock::time_point other;
    SessionTime after;
    friend constexpr bool operator==(const ClockPairOf&, const ClockPairOf&) = default;
};
using ClockPair = ClockPairOf<TrackerClock>;

} // namespace overt
