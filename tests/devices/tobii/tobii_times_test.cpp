// When Tobii's driver says what, and what it takes for the same, by a clock that goes only where it is waited
// for.
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/tobii/tobii_bench.h"
#include "tests/support/counted_clock.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

struct TimedTobii {
    TimedTobii() {
        wish.both_eyes = false;
        wish.eye = Eye::right;
        wish.rate_hz = 600.0;
    }
    /// Reads without waiting until so many samples came; what came is kept.
    void read_samples(std::size_t wanted) {
        for (int tries = 0; tries < 5000 && kept.all<GazeSample>().size() < wanted; ++tries) {
            REQUIRE(driver.read(kept, clock.time) == RecordingState::running);
            std::this_thread::sleep_for(1ms);
        }
        REQUIRE(kept.all<GazeSample>().size() >= wanted);
    }

    StandInLibrary library{OVERT_STAND_IN_TOBII};
    CountedClock clock;
    TobiiSettings settings{.library = OVERT_STAND_IN_TOBII, .longest_delay = 70ms};
    TrackerWish wish;
    KeptItems kept;
    TobiiDriver driver{settings, clock};
};

} // namespace

TEST_CASE("a Tobii is lost when it is silent for longer than is allowed, and read until the deadline",
          "[unit]") {
    TimedTobii bench;
    bench.library.set("silent_from", 0);
    bench.library.set("capabilities", 0b101001); // no port, which would tell at once where it stands
    bench.driver.connect(bench.wish);
    bench.driver.start();
    const SessionTime began = bench.clock.time;
    CHECK(bench.driver.read(bench.kept, began + 2500us) == RecordingState::running);
    CHECK(bench.clock.waits == std::vector<SessionDuration>{1ms, 1ms, 500us});
    CHECK(bench.driver.read(bench.kept, began + 2s) == RecordingState::running);
    CHECK(bench.clock.time == began + 2s);
    CHECK(bench.kept.items.empty());
    CHECK(bench.driver.read(bench.kept, began + 3s) == RecordingState::lost);
    CHECK(bench.clock.time > began + 2s);
    CHECK(bench.clock.time <= began + 2001ms);
    REQUIRE(bench.kept.items.size() == 1);
    CHECK(bench.kept.all<TrackerGap>().at(0).reason == TrackerGap::Reason::connection);
}

TEST_CASE("arrivals bound a Tobii's clock at the first sample, and again half a second after it", "[unit]") {
    TimedTobii bench;
    bench.library.set("syncs", 0);
    bench.driver.connect(bench.wish);
    bench.driver.start();
    const SessionTime began = bench.clock.time;
    bench.read_samples(3);
    auto pairs = bench.kept.all<ClockPair>();
    REQUIRE(pairs.size() == 1);
    CHECK(pairs[0].before == began - 70ms);
    CHECK(pairs[0].after == began);
    bench.clock.time = began + 500ms - 1ns;
    bench.read_samples(bench.kept.all<GazeSample>().size() + 3);
    CHECK(bench.kept.all<ClockPair>().size() == 1);
    bench.clock.time = began + 500ms;
    bench.read_samples(bench.kept.all<GazeSample>().size() + 3);
    pairs = bench.kept.all<ClockPair>();
    REQUIRE(pairs.size() == 2);
    CHECK(pairs[1].before == began + 430ms);
    CHECK(pairs[1].after == began + 500ms);
    bench.driver.stop();
    // Another recording begins with one of its own.
    bench.driver.start();
    bench.read_samples(bench.kept.all<GazeSample>().size() + 3);
    CHECK(bench.kept.all<ClockPair>().size() == 3);
}

TEST_CASE("a reading of a Tobii's clock is as wide as the library's exchange, and a microsecond at each end",
          "[unit]") {
    TimedTobii bench;
    bench.driver.connect(bench.wish);
    const auto pair = bench.driver.read_clocks();
    REQUIRE(pair);
    CHECK(pair->after - pair->before == 302us);
    CHECK(pair->before < bench.clock.time);
    CHECK(pair->after <= bench.clock.time + 1us);
}

TEST_CASE("a Tobii's screen may differ by 3 percent in each direction from the one that is told", "[unit]") {
    TimedTobii bench;
    bench.wish.screen.screen_mm = {1000.0, 500.0};
    const auto takes = [&](double width_mm, double height_mm) {
        bench.library.set("width_mm", width_mm);
        bench.library.set("height_mm", height_mm);
        try {
            bench.driver.connect(bench.wish);
        } catch (const DeviceError&) {
            return false;
        }
        return true;
    };
    CHECK(takes(1000, 500));
    CHECK(takes(1030, 515)); // exactly
    CHECK(takes(970, 485));
    CHECK_FALSE(takes(1030.5, 500));
    CHECK_FALSE(takes(969.5, 500));
    CHECK_FALSE(takes(1000, 515.5));
    CHECK_FALSE(takes(1000, 484.5));
    CHECK_FALSE(takes(500, 1000));
}

TEST_CASE("a Tobii that does not tell its rates, or tells none, is refused", "[unit]") {
    TimedTobii bench;
    bench.library.set("hz", 0);
    CHECK_THROWS_WITH(bench.driver.connect(bench.wish), Contains("does not tell its sampling rate (error 0"));
    bench.library.set("hz", 600);
    for (const int without : {1 << 3, 1 << 5}) { // gaze, or calibration on a screen
        bench.library.set("capabilities", 0b101011 & ~without);
        CHECK_THROWS_WITH(bench.driver.connect(bench.wish), Contains("does not measure gaze on a screen"));
    }
    // What is not recording is not stopped, and what was reached is let go in the end.
    bench.library.set("capabilities", 0b101011);
    bench.driver.connect(bench.wish);
    bench.driver.stop();
    CHECK_FALSE(bench.library.heard("unsubscribe gaze"));
    bench.driver.start();
    bench.driver.stop();
    bench.driver.stop();
    CHECK(std::ranges::count(bench.library.said(), "unsubscribe gaze") == 1);
    CHECK(bench.driver.finish("", {}).empty());
    CHECK_FALSE(bench.driver.read_clocks());
}

TEST_CASE("a Tobii that is connected anew has not told the time, until it does", "[unit]") {
    TimedTobii bench;
    bench.driver.connect(bench.wish);
    REQUIRE(bench.driver.read_clocks());
    bench.driver.start();
    bench.read_samples(3);
    CHECK(bench.kept.all<ClockPair>().empty());
    bench.driver.stop();
    bench.library.set("syncs", 0);
    bench.driver.connect(bench.wish);
    bench.kept.items.clear();
    bench.driver.start();
    bench.read_samples(3);
    CHECK(bench.kept.all<ClockPair>().size() == 1);
    bench.driver.stop();
}

TEST_CASE("a Tobii's measurement of the same time as the one before has no place beside it", "[unit]") {
    TimedTobii bench;
    bench.library.set("twice_at", 5);
    bench.driver.connect(bench.wish);
    bench.driver.start();
    bench.read_samples(10);
    bench.driver.stop();
    const auto samples = bench.kept.all<GazeSample>();
    for (std::size_t i = 1; i < samples.size(); ++i)
        CHECK(samples[i].sampled_at > samples[i - 1].sampled_at);
    const auto gaps = bench.kept.all<TrackerGap>();
    REQUIRE(gaps.size() == 1);
    CHECK(gaps[0].reason == TrackerGap::Reason::unreadable);
    CHECK(gaps[0].after == samples[5].sampled_at);
}

TEST_CASE("each measurement of a Tobii's that is missing is told, one alone too", "[unit]") {
    for (const int missing : {1, 2}) {
        TimedTobii bench;
        bench.library.set("missing_from", 5);
        bench.library.set("missing_count", missing);
        bench.driver.connect(bench.wish);
        bench.driver.start();
        bench.read_samples(10);
        bench.driver.stop();
        const auto gaps = bench.kept.all<TrackerGap>();
        REQUIRE(gaps.size() == 1);
        CHECK(gaps[0].reason == TrackerGap::Reason::connection);
        CHECK(gaps[0].lost_samples == missing);
        CHECK(gaps[0].after == bench.kept.all<GazeSample>().at(4).sampled_at);
    }
}
