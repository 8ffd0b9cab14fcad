#include "devices/opengaze/opengaze_clock.h"

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

namespace {

OpenGazeRecord record_at(double time_s, std::int64_t ticks) {
    OpenGazeRecord record;
    record.time_s = time_s;
    record.ticks = ticks;
    return record;
}

double s_of(std::optional<TrackerTime> time) {
    REQUIRE(time);
    return static_cast<double>(time->time_since_epoch().count()) * 1e-6;
}

} // namespace

TEST_CASE("a told frequency of ticks is taken only where two records bear it out", "[unit]") {
    const OpenGazeRecord first = record_at(10.0, 5'000'000'000), second = record_at(10.5, 5'005'000'000);
    CHECK(proven_tick_hz(1e7, first, second) == 1e7);
    // The document's own example: the bits of a double read as a whole number.
    CHECK_FALSE(proven_tick_hz(4704405731611246592.0, first, second));
    CHECK_FALSE(proven_tick_hz(0.0, first, second));
    CHECK_FALSE(proven_tick_hz(std::nullopt, first, second));
    CHECK_FALSE(proven_tick_hz(1e7, first, record_at(10.05, 5'000'500'000)));
    OpenGazeRecord without = second;
    without.ticks.reset();
    CHECK_FALSE(proven_tick_hz(1e7, first, without));
}

TEST_CASE("records of Open Gaze are timed by their ticks where those are proven, else by seconds", "[unit]") {
    OpenGazeClock clock;
    CHECK(s_of(clock.time_of(record_at(4.99716, 123), SessionTime(1s))) == Approx(4.99716));
    CHECK(s_of(clock.time_of(record_at(5.01366, 456), SessionTime(1s))) == Approx(5.01366));
    OpenGazeClock ticking;
    ticking.use_ticks(1e7);
    CHECK(s_of(ticking.time_of(record_at(1.0, 2'096'547'271'623), SessionTime(1s))) ==
          Approx(209654.7271623));
    CHECK_FALSE(ticking.time_of(OpenGazeRecord{}, SessionTime(2s)));
    // What cannot be counted in nanoseconds is no time.
    CHECK_FALSE(clock.time_of(record_at(1e300, 0), SessionTime(2s)));
    CHECK_FALSE(ticking.time_of(record_at(0.0, 2'000'000'000'000'000'000), SessionTime(2s)));
}

TEST_CASE("the tracker's clock goes on where a calibration has its seconds begin anew", "[unit]") {
    OpenGazeClock clock;
    CHECK(s_of(clock.time_of(record_at(100.0, 0), SessionTime(10s))) == Approx(100.0));
    CHECK(s_of(clock.time_of(record_at(0.5, 0), SessionTime(14s))) == Approx(104.0));
    CHECK(s_of(clock.time_of(record_at(0.75, 0), SessionTime(14s))) == Approx(104.25));
}

TEST_CASE("a change of the source of time, as after a reconnection, makes no jump", "[unit]") {
    OpenGazeClock clock;
    CHECK(s_of(clock.time_of(record_at(100.0, 0), SessionTime(10s))) == Approx(100.0));
    clock.use_ticks(1e6);
    CHECK(s_of(clock.time_of(record_at(101.0, 900'000'000), SessionTime(11s))) == Approx(101.0));
    clock.use_ticks(1e6);
    CHECK(s_of(clock.time_of(record_at(102.0, 901'500'000), SessionTime(12s))) == Approx(102.5));
}

TEST_CASE("where nothing ticks, or something is not told, no frequency is proven", "[unit]") {
    const OpenGazeRecord first = record_at(10.0, 5'000'000'000), second = record_at(10.5, 5'005'000'000);
    CHECK_FALSE(proven_tick_hz(0.0, first, record_at(10.5, 5'000'000'000)));
    CHECK_FALSE(proven_tick_hz(-1e7, record_at(10.0, 5'005'000'000), record_at(10.5, 5'000'000'000)));
    CHECK(proven_tick_hz(0.5, record_at(10.0, 5), record_at(14.0, 7)) == 0.5); // slow, and proven
    const auto without = [](OpenGazeRecord record, bool ticks) {
        if (ticks)
            record.ticks.reset();
        else
            record.time_s.reset();
        return record;
    };
    for (const bool ticks : {true, false}) {
        CHECK_FALSE(proven_tick_hz(1e7, without(first, ticks), second));
        CHECK_FALSE(proven_tick_hz(1e7, first, without(second, ticks)));
    }
}
