/// A tracker's clock that is set, or begins anew, within a sitting.
#include "experiment/clock_map.h"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/session_times.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A clock 30 ppm too fast that shows `offset_s` more than the session's, read within 0.2 ms.
TrackerTime shown_at(SessionTime time, double offset_s) {
    const double s = to_seconds(time - SessionTime{}) * (1.0 + 30e-6) + offset_s;
    return TrackerTime(TrackerClock::duration(std::llround(s * 1e6)));
}
ClockPair read_at(double s, double offset_s) {
    return {at_s(s) - 100us, shown_at(at_s(s), offset_s), at_s(s) + 100us};
}

std::vector<ClockPair> pairs_between(double from_s, double until_s, double offset_s) {
    std::vector<ClockPair> pairs;
    for (double s = from_s; s <= until_s; s += 5.0)
        pairs.push_back(read_at(s, offset_s));
    return pairs;
}

/// Readings until 100 s and from 105 s on, when the clock shows so much more.
std::vector<ClockPair> with_jump(double jump_s) {
    std::vector<ClockPair> pairs = pairs_between(0.0, 100.0, 1000.0);
    for (const ClockPair& pair : pairs_between(105.0, 200.0, 1000.0 + jump_s))
        pairs.push_back(pair);
    return pairs;
}

} // namespace

TEST_CASE("a jump of the clock is found from what two steady clocks cannot differ by", "[unit]") {
    CHECK_FALSE(clock_jump(read_at(0.0, 0.0), read_at(100.0, 0.0)));
    const auto forward = clock_jump(read_at(0.0, 0.0), read_at(1.0, 0.002));
    REQUIRE(forward);
    CHECK(to_seconds(*forward) == Approx(0.00203));
    CHECK(clock_jump(read_at(0.0, 0.0), read_at(1.0, -0.002)));
    // Within a millisecond, or within 200 ppm of a long time, it may be the clocks' own difference.
    CHECK_FALSE(clock_jump(read_at(0.0, 0.0), read_at(1.0, 0.001)));
    CHECK_FALSE(clock_jump(read_at(0.0, 0.0), read_at(100.0, 0.017)));
    CHECK(clock_jump(read_at(0.0, 0.0), read_at(100.0, 0.022)));
}

TEST_CASE("before and after a jump, times are exact by their own run of the clock", "[unit]") {
    for (const double jump_s : {0.25, -0.25, 3600.0, -900.0}) {
        CAPTURE(jump_s);
        const ClockMap map(with_jump(jump_s));
        REQUIRE(map.run_count() == 2);
        for (const double s : {10.0, 60.0, 99.0, 106.0, 150.0, 199.0}) {
            const SessionTime time = at_s(s);
            const MappedTime mapped = map.to_session(shown_at(time, 1000.0 + (s > 102.0 ? jump_s : 0.0)));
            CHECK(std::chrono::abs(mapped.time - time) <= mapped.uncertainty);
            CHECK(mapped.uncertainty < 1ms);
            CHECK(std::chrono::abs(map.to_session(map.to_other(time)).time - time) < 2us);
        }
    }
}

TEST_CASE("times that two runs of the clock showed are uncertain, unless it is known when they were",
          "[unit]") {
    // Put back by 50 s: it shows the last 50 s before the jump once more.
    const ClockMap map(with_jump(-50.0));
    REQUIRE(map.run_count() == 2);
    const TrackerTime twice = shown_at(at_s(80.0), 1000.0);
    CHECK(map.to_session(twice).uncertainty > 49s);
    CHECK(std::chrono::abs(map.at(at_s(79.0)).to_session(twice).time - at_s(80.0)) < 1ms);
    CHECK(map.at(at_s(79.0)).to_session(twice).uncertainty < 1ms);
    CHECK(std::chrono::abs(map.at(at_s(120.0)).to_session(twice).time - at_s(130.0)) < 2ms);
}

TEST_CASE("a single reading that lies off the line begins no run, but widens the bound", "[unit]") {
    std::vector<ClockPair> pairs = pairs_between(0.0, 100.0, 1000.0);
    const SessionDuration narrow = ClockMap(pairs).to_session(shown_at(at_s(50.0), 1000.0)).uncertainty;
    pairs[10] = read_at(50.0, 1000.02);
    const ClockMap map(pairs);
    CHECK(map.run_count() == 1);
    const MappedTime mapped = map.to_session(shown_at(at_s(50.0), 1000.0));
    CHECK(mapped.uncertainty > 10 * narrow);
    CHECK(std::chrono::abs(mapped.time - at_s(50.0)) <= mapped.uncertainty);
}
