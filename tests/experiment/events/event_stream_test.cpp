/// The detector as it is used: samples as they come, with gaps and damages, and its settings.
#include "experiment/events/event_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/experiment/events/detected_events.h"
#include "tests/experiment/events/gaze_trace.h"

using namespace overt;
using namespace overt::testing;
using Kind = GazeEvent::Kind;

TEST_CASE("nothing is said across a gap in the samples, and a short one is bridged", "[unit]") {
    Trace gap(500.0);
    gap.rest(0.3, 0.0).skip(0.2).rest(0.3, 0.0);
    const std::vector<GazeEvent> found = detect(gap.samples);
    REQUIRE(found.size() == 2);
    CHECK(found[0].kind == Kind::fixation);
    CHECK(found[0].end == gap.samples[149].sampled_at);
    CHECK(found[1].kind == Kind::fixation);
    CHECK(found[1].start == gap.samples[150].sampled_at);
    // No velocity is reckoned over it, either.
    Trace jump(500.0);
    jump.rest(0.3, 0.0).skip(0.2).rest(0.3, 6.0);
    CHECK(of_kind(detect(jump.samples), Kind::saccade).empty());
    Trace bridged(500.0);
    bridged.rest(0.3, 0.0).skip(0.02).rest(0.3, 0.0);
    CHECK(detect(bridged.samples).size() == 1);
}

TEST_CASE("samples twice or out of order change nothing, and an earlier time begins a recording", "[unit]") {
    Trace trace(1000.0);
    trace.rest(0.2, 0.0).glide(0.03, 0.0, 6.0).rest(0.2, 6.0);
    std::vector<GazeSample> disturbed;
    for (const GazeSample& sample : trace.samples) {
        disturbed.push_back(sample);
        disturbed.push_back(sample);
        if (disturbed.size() > 10)
            disturbed.push_back(disturbed[disturbed.size() - 7]);
    }
    CHECK(detect(disturbed) == detect(trace.samples));

    // A trial after the other, on a clock that was set back.
    std::vector<GazeSample> twice = trace.samples;
    twice.insert(twice.end(), trace.samples.begin(), trace.samples.end());
    std::vector<GazeEvent> expected = detect(trace.samples);
    const std::vector<GazeEvent> again = expected;
    expected.insert(expected.end(), again.begin(), again.end());
    CHECK(detect(twice) == expected);
}

TEST_CASE("what came before does not matter to a recording after finish", "[unit]") {
    const PlantedGaze first = planted_at(1000.0, 0.02, 10.0);
    Trace second(1000.0);
    second.rest(0.2, 0.0).glide(0.03, 0.0, 6.0).rest(0.2, 6.0);
    EventList list;
    EventDetector detector({}, angles, list);
    for (const GazeSample& sample : first.samples)
        detector.push(sample);
    detector.finish();
    list.events.clear();
    for (const GazeSample& sample : second.samples)
        detector.push(sample);
    detector.finish();
    CHECK(list.events == detect(second.samples));
}

TEST_CASE("irregular time stamps change few events", "[unit]") {
    const PlantedGaze jittered =
        plant_gaze({.rate_hz = 250.0, .noise_deg = 0.02, .jitter_s = 0.0004}, screen);
    CHECK(agreement(Kind::fixation, jittered.events, detect(jittered.samples)).f1() > 0.98);
}

TEST_CASE("each setting does what it says", "[unit]") {
    // 0.6 degrees at 50 deg/s: far and fast enough.
    Trace small(1000.0);
    small.rest(0.3, 0.0).glide(0.012, 0.0, 0.6).rest(0.3, 0.6);
    const EventSettings plain{.acceleration_deg_s2 = 0.0, .pursuit_deg_s = 0.0};
    const auto saccades = [&](EventSettings settings) {
        return of_kind(detect(small.samples, settings), Kind::saccade).size();
    };
    CHECK(saccades(plain) == 1);
    EventSettings changed = plain;
    changed.velocity_deg_s = 60.0;
    CHECK(saccades(changed) == 0);
    changed = plain;
    changed.motion_deg = 1.0;
    CHECK(saccades(changed) == 0);
    changed = plain;
    changed.onset_verify_ms = 30.0;
    CHECK(saccades(changed) == 0);
    // Two saccades 15 ms apart are one.
    Trace two(1000.0);
    two.rest(0.3, 0.0).glide(0.02, 0.0, 4.0).rest(0.025, 4.0).glide(0.02, 4.0, 8.0).rest(0.3, 8.0);
    CHECK(of_kind(detect(two.samples, plain), Kind::saccade).size() == 1);
    changed = plain;
    changed.offset_verify_ms = 8.0;
    CHECK(of_kind(detect(two.samples, changed), Kind::saccade).size() == 2);
    // By its acceleration a saccade is seen to begin earlier, and to end later, than by its speed alone.
    changed = plain;
    changed.acceleration_deg_s2 = 8000.0;
    const GazeEvent by_speed = of_kind(detect(two.samples, plain), Kind::saccade).front(),
                    by_both = of_kind(detect(two.samples, changed), Kind::saccade).front();
    CHECK(by_both.start < by_speed.start);
    CHECK(by_both.end > by_speed.end);
    // Without any speed there is none, whatever the acceleration.
    changed.velocity_deg_s = 1000.0;
    CHECK(of_kind(detect(two.samples, changed), Kind::saccade).empty());
}

TEST_CASE("an event is told soon after its end, and what goes on is not told", "[unit]") {
    const PlantedGaze planted = planted_at(1000.0, 0.01, 20.0);
    EventList list;
    EventDetector detector({}, angles, list);
    std::size_t told = 0;
    TrackerClock::duration latest{};
    for (const GazeSample& sample : planted.samples) {
        detector.push(sample);
        for (; told < list.events.size(); ++told)
            latest = std::max(latest, sample.sampled_at - list.events[told].end);
    }
    REQUIRE(told > 50);
    CHECK(latest <= std::chrono::milliseconds(20 + 8 + 2));
}

TEST_CASE("finishing after each trial gives what detecting each trial alone gives", "[unit]") {
    std::vector<GazeEvent> alone;
    EventList together;
    EventDetector detector({}, angles, together);
    for (std::uint64_t trial = 0; trial < 5; ++trial) {
        PlantedGaze planted = plant_gaze({.rate_hz = 500.0, .duration_s = 3.0, .seed = trial}, screen);
        for (GazeSample& sample : planted.samples)
            sample.sampled_at += std::chrono::seconds(3 * trial);
        const std::vector<GazeEvent> events = detect(planted.samples);
        alone.insert(alone.end(), events.begin(), events.end());
        for (const GazeSample& sample : planted.samples)
            detector.push(sample);
        detector.finish();
    }
    CHECK(together.events == alone);
}

TEST_CASE("times beyond all clocks are left out", "[unit]") {
    Trace trace(1000.0);
    trace.rest(0.2, 0.0).glide(0.03, 0.0, 6.0).rest(0.2, 6.0);
    std::vector<GazeSample> damaged = trace.samples;
    for (const std::int64_t time :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
        damaged.insert(damaged.begin() + 100, {tracker_time(time), Eye::right, place(1.0), 1.0f});
    CHECK(detect(damaged) == detect(trace.samples));
}

TEST_CASE("no sample, one sample, and only lost ones", "[unit]") {
    CHECK(detect({}).empty());
    Trace one(1000.0);
    one.rest(0.001, 1.0);
    REQUIRE(detect(one.samples).size() == 1);
    CHECK(detect(one.samples).front().kind == Kind::fixation);
    Trace lost(1000.0);
    lost.lose(1.0);
    const std::vector<GazeEvent> events = detect(lost.samples);
    REQUIRE(events.size() == 2);
    CHECK(events[0].kind == Kind::blink);
    CHECK(events[1].kind == Kind::saccade);
    CHECK_FALSE(events[1].place);
    CHECK_FALSE(events[1].amplitude_deg);
}
