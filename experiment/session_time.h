/// The two clocks of a session. They are different types, so the compiler refuses to mix them: only a
/// ClockMap crosses.
#pragma once

#include <chrono>
#include <cstdint>

namespace overt {

/// The session's own clock: steady, zero at the start of the session, counted in nanoseconds.
struct SessionClock {
    using rep = std::int64_t;
    using period = std::nano;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<SessionClock>;
    static constexpr bool is_steady = true;
};
using SessionTime = SessionClock::time_point;
using SessionDuration = SessionClock::duration;

/// The eye tracker's clock, with an origin and a rate of its own, counted in microseconds (a sample at 2000
/// Hz lasts 500).
struct TrackerClock {
    using rep = std::int64_t;
    using period = std::micro;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<TrackerClock>;
    static constexpr bool is_steady = true;
};
using TrackerTime = TrackerClock::time_point;

/// Microseconds of the tracker's clock.
constexpr TrackerTime tracker_time(std::int64_t us) { return TrackerTime(TrackerClock::duration(us)); }

template <class A, class B>
concept Subtractable = requires(A a, B b) {
    a - b;
};
static_assert(!Subtractable<SessionTime, TrackerTime>, "two machines' clocks must not be mixed");

/// Seconds since the session's start.
constexpr double to_seconds(SessionTime time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}
constexpr double to_seconds(SessionDuration duration) {
    return std::chrono::duration<double>(duration).count();
}

/// The nearest nanosecond to a number of seconds.
constexpr SessionDuration from_seconds(double seconds) {
    const double nanoseconds = seconds * 1e9;
    return SessionDuration(static_cast<std::int64_t>(nanoseconds + (nanoseconds < 0.0 ? -0.5 : 0.5)));
}

} // namespace overt
