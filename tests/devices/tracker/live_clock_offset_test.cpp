#include "devices/tracker/live_clock_offset.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

namespace {

/// A tracker's clock that is 1000 s ahead of the session's and runs 50 ppm faster.
TrackerTime other_at(SessionTime at) {
    return tracker_time(1'000'000'000 + std::llround(to_seconds(at) * 1e6 * (1.0 + 50e-6)));
}

double error_s(const LiveClockOffset& offset, SessionTime at) {
    return to_seconds(*offset.session_time_of(other_at(at)) - at);
}

} // namespace

TEST_CASE("a tracker's time becomes a session time by what all readings allow", "[unit]") {
    LiveClockOffset offset;
    CHECK_FALSE(offset.session_time_of(tracker_time(5)));
    // Two-way readings of 2 ms, off by what lies between question and answer.
    for (int i = 0; i < 100; ++i) {
        const SessionTime at = SessionTime(1s * i);
        offset.take({at - (i % 2 == 0 ? 100us : 1900us), other_at(at), at + (i % 2 == 0 ? 1900us : 100us)});
        CHECK(std::abs(error_s(offset, at)) < 1e-3);
    }
    // The clocks have gone apart by 5 ms by now; what counts is the last reading, and not the first.
    CHECK(std::abs(error_s(offset, SessionTime(100s))) < 1e-3);
}

TEST_CASE("a clock that was set begins anew", "[unit]") {
    LiveClockOffset offset;
    offset.take({SessionTime(1s) - 1ms, tracker_time(5'000'000), SessionTime(1s) + 1ms});
    offset.take({SessionTime(2s) - 1ms, tracker_time(500'000), SessionTime(2s) + 1ms});
    CHECK(*offset.session_time_of(tracker_time(500'000)) == SessionTime(2s));
}

TEST_CASE("what readings say of an offset widens by 200 ppm of the time since the last", "[unit]") {
    // A tracker's clock that was 0 with the session's; each reading tells less to one side.
    const auto offset_after = [](SessionDuration between, SessionDuration low, SessionDuration high) {
        LiveClockOffset offset;
        offset.take({SessionTime(100s) - 1ms, tracker_time(100'000'000), SessionTime(100s) + 1ms});
        const SessionTime at = SessionTime(100s) + between;
        const auto us = std::chrono::duration_cast<std::chrono::microseconds>(at.time_since_epoch()).count();
        offset.take({at - low, tracker_time(us), at + high});
        return to_seconds(*offset.session_time_of(tracker_time(us)) - at);
    };
    // Of wider readings what was known counts, and what it may have drifted since: 10 s after, 2 ms.
    CHECK(offset_after(10s, 1s, 500us) == Approx(0.5 * (-0.003 + 0.0005)).margin(3e-7));
    CHECK(offset_after(10s, 500us, 1s) == Approx(0.5 * (-0.0005 + 0.003)).margin(3e-4));
    CHECK(offset_after(0s, 1s, 1s) == Approx(0.0).margin(3e-4));
    CHECK(offset_after(10s, 100us, 200us) == Approx(0.00005).margin(1e-9));
}
