#include "experiment/clock_map.h"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/box_time.h"
#include "tests/support/session_times.h"

using namespace overt;
using namespace overt::test;

// Each machine has a clock type of its own, and so a map of its own: readings of one do not fit the other.
static_assert(std::is_constructible_v<ClockMap, std::span<const ClockPair>>);
static_assert(!std::is_constructible_v<ClockMap, std::span<const BoxClockPair>>);
static_assert(!std::is_invocable_v<decltype(&BoxClockMap::to_session), BoxClockMap, TrackerTime>);

namespace {

/// A tracker whose clock has an origin and a rate of its own.
struct TrackerTruth {
    SessionTime origin; ///< session time at which the tracker's clock shows `shows`
    TrackerTime shows;
    double drift_ppm = 40.0; ///< a second of the tracker's lasts this much longer than one of the session's

    TrackerTime tracker_at(SessionTime time) const {
        const double ns = static_cast<double>((time - origin).count()) / (1.0 + 1e-6 * drift_ppm);
        return shows + TrackerClock::duration(static_cast<std::int64_t>(std::floor(ns / 1000.0)));
    }
    /// The tracker is read at a random instant of a round trip that is long now and then.
    ClockPair read(SessionTime at, RandomStream& random, double round_trip_us) const {
        const double trip_ns = 1000.0 * round_trip_us * (0.2 + random.exponential(1.0));
        const SessionTime read_at = at + SessionDuration(std::llround(random.uniform() * trip_ns));
        return {at, tracker_at(read_at), at + SessionDuration(std::llround(trip_ns))};
    }
};

TrackerTruth example_truth(double drift_ppm = 40.0) {
    return {at_s(17.25), TrackerTime(std::chrono::hours(30)), drift_ppm};
}

} // namespace

TEST_CASE("the clock map finds the tracker's offset and drift to within its stated uncertainty", "[unit]") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        RandomStream random(seed, "clock map test");
        const TrackerTruth truth = example_truth(random.uniform(-150.0, 150.0));
        std::vector<ClockPair> pairs;
        for (int i = 0; i < 60; ++i)
            pairs.push_back(truth.read(at_s(20.0 + 10.0 * i), random, 100.0));
        const ClockMap map(pairs);
        CHECK(std::abs(map.drift_ppm() - truth.drift_ppm) <= map.drift_uncertainty_ppm());
        CHECK(map.drift_uncertainty_ppm() < 1.0);
        for (int i = 0; i < 200; ++i) {
            const SessionTime time = at_s(random.uniform(0.0, 700.0));
            const MappedTime mapped = map.to_session(truth.tracker_at(time));
            CHECK(std::chrono::abs(mapped.time - time) <= mapped.uncertainty);
            CHECK(mapped.uncertainty < std::chrono::microseconds(500));
        }
    }
}

TEST_CASE("one slow reading of the clocks hardly moves the map", "[unit]") {
    RandomStream random(1, "clock map test");
    const TrackerTruth truth = example_truth();
    std::vector<ClockPair> pairs;
    for (int i = 0; i < 20; ++i)
        pairs.push_back(truth.read(at_s(20.0 + 10.0 * i), random, 20.0));
    const ClockMap without(pairs);
    // 30 ms of waiting, all of it before the tracker was read.
    const SessionTime slow = at_s(150.0);
    pairs.push_back(
        {slow, truth.tracker_at(slow + std::chrono::milliseconds(30)), slow + std::chrono::milliseconds(30)});
    const ClockMap with(pairs);
    for (int i = 0; i < 20; ++i) {
        const TrackerTime time = truth.tracker_at(at_s(10.0 * i));
        CHECK(std::chrono::abs(with.to_session(time).time - without.to_session(time).time) <
              std::chrono::microseconds(1));
        CHECK(with.to_session(time).uncertainty <
              without.to_session(time).uncertainty + std::chrono::microseconds(2));
    }
}

TEST_CASE("with one pair the rate is taken as 1, and the uncertainty grows with the distance", "[unit]") {
    const TrackerTruth truth = example_truth();
    RandomStream random(2, "clock map test");
    const std::vector<ClockPair> pairs{truth.read(at_s(20.0), random, 50.0)};
    const ClockMap map(pairs);
    CHECK(map.drift_ppm() == 0.0);
    CHECK(map.drift_uncertainty_ppm() == Approx(ClockMapOf<TrackerClock>::largest_drift_ppm));
    const MappedTime first = map.to_session(pairs[0].other);
    CHECK(first.time >= pairs[0].before);
    CHECK(first.time <= pairs[0].after);
    const MappedTime later = map.to_session(pairs[0].other + std::chrono::seconds(100));
    CHECK(later.time - first.time == std::chrono::seconds(100));
    CHECK(later.uncertainty >= std::chrono::milliseconds(20));
    CHECK(std::chrono::abs(later.time - (first.time + std::chrono::microseconds(100'004'000))) <=
          later.uncertainty);
}

TEST_CASE("pairs that are close together do not pretend to know the rate", "[unit]") {
    const TrackerTruth truth = example_truth(-40.0);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        RandomStream random(seed, "clock map test");
        const std::vector<ClockPair> pairs{truth.read(at_s(20.0), random, 200.0),
                                           truth.read(at_s(20.01), random, 200.0)};
        const ClockMap map(pairs);
        const SessionTime time = at_s(600.0);
        const MappedTime mapped = map.to_session(truth.tracker_at(time));
        CHECK(std::chrono::abs(mapped.time - time) <= mapped.uncertainty);
        CHECK(mapped.uncertainty < std::chrono::milliseconds(130));
    }
}

TEST_CASE("where the rate is not known, it makes the offset of the pairs uncertain, too", "[unit]") {
    // Exact readings, so that what is left is the tick of 1 us at a pair and at the time asked for, and 200
    // ppm of the 5 ms between the pairs and their middle.
    std::vector<ClockPair> pairs;
    for (const int ms : {0, 10})
        pairs.push_back(
            {at_s(20.0 + 0.001 * ms), tracker_time(5'000'000 + 1000 * ms), at_s(20.0 + 0.001 * ms)});
    const ClockMap map(pairs);
    CHECK(map.drift_ppm() == 0.0);
    CHECK(map.drift_uncertainty_ppm() == Approx(ClockMapOf<TrackerClock>::largest_drift_ppm));
    CHECK(map.to_session(tracker_time(5'005'000)).uncertainty == std::chrono::nanoseconds(3000));
    CHECK(map.to_session(tracker_time(6'005'000)).uncertainty == std::chrono::nanoseconds(203'000));
}

TEST_CASE("no nanosecond is lost after years of uptime", "[unit]") {
    const SessionTime session(SessionDuration(3'000'000'000'000'000'001));
    const TrackerTime tracker(TrackerClock::duration(4'000'000'000'000'003));
    std::vector<ClockPair> pairs;
    for (int i = 0; i < 10; ++i)
        pairs.push_back({session + std::chrono::seconds(i), tracker + std::chrono::seconds(i),
                         session + std::chrono::seconds(i)});
    const ClockMap map(pairs);
    for (std::int64_t microseconds : {0, 1, 999'999, 86'400'000})
        CHECK(map.to_session(tracker + TrackerClock::duration(microseconds)).time ==
              session + std::chrono::microseconds(microseconds));
}

TEST_CASE("a rate that was not constant widens the uncertainty until every pair fits", "[unit]") {
    TrackerTruth truth = example_truth();
    std::vector<ClockPair> pairs;
    for (int i = 0; i < 40; ++i) {
        // The crystal warms up: its error against a straight line reaches about half a millisecond.
        const SessionTime time = at_s(20.0 + 10.0 * i);
        pairs.push_back({time, truth.tracker_at(time) + TrackerClock::duration(2 * i * (40 - i) / 2), time});
    }
    const ClockMap map(pairs);
    bool was_needed = false;
    for (const ClockPair& pair : pairs) {
        const MappedTime mapped = map.to_session(pair.other);
        CHECK(std::chrono::abs(mapped.time - pair.before) <= mapped.uncertainty);
        was_needed =
            was_needed || std::chrono::abs(mapped.time - pair.before) > std::chrono::microseconds(50);
    }
    CHECK(was_needed);
}

TEST_CASE("over a link with 5 ms of jitter, 50 ppm come back within what is stated", "[unit]") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        RandomStream random(seed, "jitter of a link");
        const TrackerTruth truth = example_truth(seed % 2 == 0 ? 50.0 : -50.0);
        std::vector<ClockPair> pairs;
        // Once a second for ten minutes, each way anything up to 5 ms.
        for (int i = 0; i < 600; ++i) {
            const SessionTime before = at_s(20.0 + i);
            const SessionTime read_at = before + from_seconds(random.uniform(0.0, 0.005));
            pairs.push_back(
                {before, truth.tracker_at(read_at), read_at + from_seconds(random.uniform(0.0, 0.005))});
        }
        const ClockMap map(pairs);
        CHECK(std::abs(map.drift_ppm() - truth.drift_ppm) <= map.drift_uncertainty_ppm());
        CHECK(std::abs(map.drift_ppm() - truth.drift_ppm) < 3.0);
        for (double at = 20.0; at <= 620.0; at += 7.0) {
            const MappedTime mapped = map.to_session(truth.tracker_at(at_s(at)));
            CHECK(std::chrono::abs(mapped.time - at_s(at)) <= mapped.uncertainty);
            CHECK(std::chrono::abs(mapped.time - at_s(at)) < std::chrono::microseconds(1500));
        }
    }
}

TEST_CASE("arrivals alone bound a clock by the longest delay", "[unit]") {
    // Of a tracker that cannot be asked, a sample was taken at most 8 ms before it arrived.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        RandomStream random(seed, "one way");
        const TrackerTruth truth = example_truth(50.0);
        std::vector<ClockPair> pairs;
        for (int i = 0; i < 600; ++i) {
            const SessionTime sampled = at_s(20.0 + i);
            const SessionTime arrived = sampled + from_seconds(random.uniform(0.003, 0.008));
            pairs.push_back({arrived - from_seconds(0.008), truth.tracker_at(sampled), arrived});
        }
        const ClockMap map(pairs);
        CHECK(std::abs(map.drift_ppm() - 50.0) <= map.drift_uncertainty_ppm());
        for (double at = 20.0; at <= 620.0; at += 7.0) {
            const MappedTime mapped = map.to_session(truth.tracker_at(at_s(at)));
            CHECK(std::chrono::abs(mapped.time - at_s(at)) <= mapped.uncertainty);
        }
    }
}
