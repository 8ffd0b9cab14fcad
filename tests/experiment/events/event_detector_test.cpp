/// Fixations, saccades and blinks: planted ones come back, and laws hold.
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

TEST_CASE("planted fixations, saccades and blinks come back at every rate", "[unit]") {
    const auto [rate_hz, least_fixation_f1, least_saccade_f1] =
        GENERATE(std::tuple(60.0, 0.93, 0.7), std::tuple(120.0, 0.98, 0.95), std::tuple(250.0, 0.99, 0.97),
                 std::tuple(500.0, 0.99, 0.98), std::tuple(1000.0, 0.99, 0.99),
                 std::tuple(2000.0, 0.99, 0.99), std::tuple(5000.0, 0.99, 0.99));
    CAPTURE(rate_hz);
    const PlantedGaze planted = planted_at(rate_hz);
    const std::vector<GazeEvent> found = detect(planted.samples);
    const EventAgreement fixations = agreement(Kind::fixation, planted.events, found),
                         saccades = agreement(Kind::saccade, planted.events, found),
                         blinks = agreement(Kind::blink, planted.events, found);
    REQUIRE(fixations.in_reference() > 80);
    CHECK(fixations.f1() >= least_fixation_f1);
    CHECK(saccades.f1() >= least_saccade_f1);
    CHECK(blinks.f1() == 1.0);
    CHECK(blinks.in_reference() > 5);
    // The window smears the slow begin and end of a saccade over a few milliseconds, a slow tracker over a
    // sample.
    CHECK(fixations.median_onset_error_ms().value() <= std::max(6.0, 1100.0 / rate_hz));
    CHECK(fixations.median_offset_error_ms().value() <= std::max(6.0, 1100.0 / rate_hz));
}

TEST_CASE("a fixation has the mean place and pupil of its samples, a saccade its places, size and speed",
          "[unit]") {
    Trace trace(1000.0);
    const double amplitude_deg = 5.0;
    trace.rest(0.3, -2.0).glide(0.025, -2.0, -2.0 + amplitude_deg).rest(0.3, 3.0);
    const std::vector<GazeEvent> found = detect(trace.samples);
    REQUIRE(found.size() == 3);
    const GazeEvent &before = found[0], &saccade = found[1], &after = found[2];
    CHECK(before.kind == Kind::fixation);
    CHECK(saccade.kind == Kind::saccade);
    CHECK(after.kind == Kind::fixation);
    for (const GazeEvent& event : found)
        CHECK(event.eye == Eye::right);
    CHECK(angles.angle_deg(*before.place, place(-2.0)) < 0.01);
    CHECK(angles.angle_deg(*after.place, place(3.0)) < 0.01);
    CHECK(*before.pupil == Approx(900.0));
    CHECK(*saccade.amplitude_deg == Approx(amplitude_deg).margin(0.02));
    // 5 degrees in 25 ms.
    CHECK(*saccade.peak_velocity_deg_s == Approx(200.0).epsilon(0.01));
    // Without a hole between them, and each sample lasts until the next.
    const TrackerClock::duration interval(1000);
    CHECK(saccade.start == before.end + interval);
    CHECK(after.start == saccade.end + interval);
    CHECK(before.duration == before.end - before.start + interval);
    CHECK(before.start == trace.samples.front().sampled_at);
    CHECK(after.end == trace.samples.back().sampled_at);
}

TEST_CASE("samples half a millisecond apart give events of half milliseconds", "[unit]") {
    Trace trace(2000.0);
    trace.rest(0.2, 0.0).glide(0.03, 0.0, 6.0).rest(0.2, 6.0);
    const std::vector<GazeEvent> found = detect(trace.samples);
    REQUIRE(found.size() == 3);
    CHECK(found[1].start == found[0].end + TrackerClock::duration(500));
    CHECK(found[0].duration.count() % 1000 ==
          (found[0].end - found[0].start + TrackerClock::duration(500)).count() % 1000);
}

TEST_CASE("pursuit up to the speed at which saccades begin is fixation", "[unit]") {
    // A step of 25 deg/s moves the eye, but is no saccade; one of 45 deg/s is.
    for (const double speed_deg_s : {5.0, 15.0, 25.0}) {
        CAPTURE(speed_deg_s);
        Trace trace(500.0);
        trace.rest(0.3, -3.0).glide(6.0 / speed_deg_s, -3.0, 3.0).rest(0.3, 3.0);
        CHECK(detect(trace.samples, {.acceleration_deg_s2 = 0.0}).size() == 1);
    }
    Trace fast(500.0);
    fast.rest(0.3, -3.0).glide(6.0 / 45.0, -3.0, 3.0).rest(0.3, 3.0);
    CHECK(detect(fast.samples, {.acceleration_deg_s2 = 0.0, .pursuit_deg_s = 0.0}).size() == 3);
}

TEST_CASE("a saccade in the midst of fast pursuit is found, and the pursuit is none", "[unit]") {
    // 25 deg/s with noise would now and then be above 30 deg/s; the threshold rises with the speed.
    const PlantedGaze planted = plant_gaze({.rate_hz = 1000.0,
                                            .duration_s = 40.0,
                                            .noise_deg = 0.02,
                                            .shortest_saccade_deg = 3.0,
                                            .blinks_per_minute = 0.0,
                                            .pursuit_deg_s = 20.0},
                                           screen);
    const std::vector<GazeEvent> found = detect(planted.samples);
    CHECK(agreement(Kind::fixation, planted.events, found).f1() > 0.97);
    CHECK(agreement(Kind::saccade, planted.events, found).f1() > 0.97);
}

TEST_CASE("the velocity threshold rises with what the eye does anyway", "[unit]") {
    // 40 deg/s for 0.3 s: within 40 ms it is what the eye does.
    Trace trace(1000.0);
    trace.rest(0.3, -6.0).glide(0.3, -6.0, 6.0).rest(0.3, 6.0);
    const std::vector<GazeEvent> raised =
        of_kind(detect(trace.samples, {.acceleration_deg_s2 = 0.0}), Kind::saccade);
    const std::vector<GazeEvent> fixed =
        of_kind(detect(trace.samples, {.acceleration_deg_s2 = 0.0, .pursuit_deg_s = 0.0}), Kind::saccade);
    REQUIRE(fixed.size() == 1);
    CHECK(fixed[0].duration > std::chrono::milliseconds(280));
    for (const GazeEvent& saccade : raised)
        CHECK(saccade.duration < std::chrono::milliseconds(60));
}

TEST_CASE("a blink lies in a saccade that holds the movement of the lid", "[unit]") {
    const PlantedGaze planted = planted_at(1000.0, 0.01);
    const std::vector<GazeEvent> found = detect(planted.samples);
    const std::vector<GazeEvent> saccades = of_kind(found, Kind::saccade);
    int blinks = 0;
    for (const GazeEvent& blink : of_kind(found, Kind::blink)) {
        const auto around = std::find_if(saccades.begin(), saccades.end(), [&](const GazeEvent& saccade) {
            return saccade.start <= blink.start && blink.end <= saccade.end;
        });
        REQUIRE(around != saccades.end());
        // 30 ms of lid before and after.
        CHECK(around->start <= blink.start - std::chrono::milliseconds(15));
        CHECK(around->end >= blink.end + std::chrono::milliseconds(15));
        ++blinks;
    }
    CHECK(blinks > 5);
}

TEST_CASE("losses with a pupil for less than the time to verify between them are one blink", "[unit]") {
    Trace once(1000.0), twice(1000.0);
    once.rest(0.2, 0.0).lose(0.08).rest(0.01, 0.0).lose(0.06).rest(0.2, 0.0);
    twice.rest(0.2, 0.0).lose(0.08).rest(0.018, 0.0).lose(0.06).rest(0.2, 0.0);
    CHECK(of_kind(detect(once.samples), Kind::blink).size() == 1);
    const std::vector<GazeEvent> two = detect(twice.samples);
    CHECK(of_kind(two, Kind::blink).size() == 2);
    // Slow for less than 20 ms between them: one saccade holds both.
    CHECK(of_kind(two, Kind::saccade).size() == 1);
    CHECK(of_kind(detect(once.samples), Kind::fixation).size() == 2);
}

TEST_CASE("events move with the time, turn with the gaze, and stay as they are", "[unit]") {
    const PlantedGaze planted = planted_at(500.0, 0.03, 20.0);
    const std::vector<GazeEvent> found = detect(planted.samples);
    REQUIRE(found.size() > 50);
    const auto times_of = [](const std::vector<GazeEvent>& events, TrackerClock::duration less) {
        std::vector<std::tuple<Kind, TrackerTime, TrackerTime, TrackerClock::duration>> times;
        for (const GazeEvent& event : events)
            times.emplace_back(event.kind, event.start - less, event.end - less, event.duration);
        return times;
    };
    SECTION("shifted by a time") {
        const TrackerClock::duration by(123'456'789);
        std::vector<GazeSample> later = planted.samples;
        for (GazeSample& sample : later)
            sample.sampled_at += by;
        CHECK(times_of(detect(later), by) == times_of(found, {}));
    }
    SECTION("turned about the middle of the screen, and mirrored") {
        const double turn = 0.7;
        const auto turned = [&](ScreenPoint point) {
            // In millimetres: pixels need not be square.
            const double mm_x = screen.screen_mm.x / screen.screen_px.x,
                         mm_y = screen.screen_mm.y / screen.screen_px.y;
            const double x = (point.x_px - screen.centre().x_px) * mm_x,
                         y = (screen.centre().y_px - point.y_px) * mm_y;
            return ScreenPoint{screen.centre().x_px + (std::cos(turn) * x - std::sin(turn) * y) / mm_x,
                               screen.centre().y_px + (std::sin(turn) * x + std::cos(turn) * y) / mm_y};
        };
        std::vector<GazeSample> moved = planted.samples;
        for (GazeSample& sample : moved)
            if (sample.gaze)
                sample.gaze = turned(*sample.gaze);
        CHECK(times_of(detect(moved), {}) == times_of(found, {}));
    }
    SECTION("of the other eye, with this eye's samples between them") {
        std::vector<GazeSample> both;
        for (const GazeSample& sample : planted.samples) {
            both.push_back(sample);
            both.back().eye = Eye::left;
            both.push_back(sample);
        }
        const std::vector<GazeEvent> of_both = detect(both);
        std::vector<GazeEvent> left, right;
        for (const GazeEvent& event : of_both)
            (event.eye == Eye::left ? left : right).push_back(event);
        CHECK(right == found);
        CHECK(times_of(left, {}) == times_of(found, {}));
    }
    SECTION("by the recording's resolution instead of the screen's geometry") {
        // In the middle of the screen both are nearly the same.
        const double px_per_deg = screen.px_per_deg_at_centre();
        const std::vector<GazeEvent> by_resolution =
            detect(planted.samples, {}, GazeAngles(px_per_deg, px_per_deg));
        CHECK(agreement(Kind::fixation, found, by_resolution).f1() > 0.99);
        CHECK(agreement(Kind::fixation, found, by_resolution).median_onset_error_ms().value() == 0.0);
    }
}

TEST_CASE("samples turned round in time give the same fixations", "[unit]") {
    // Begins and ends have different rules, so that times may differ by a few samples.
    const PlantedGaze planted = planted_at(1000.0, 0.01);
    std::vector<GazeSample> turned = planted.samples;
    std::reverse(turned.begin(), turned.end());
    const TrackerTime last = planted.samples.back().sampled_at;
    const auto mirrored = [&](TrackerTime time) { return tracker_time((last - time).count()); };
    for (GazeSample& sample : turned)
        sample.sampled_at = mirrored(sample.sampled_at);
    std::vector<GazeEvent> back = detect(turned);
    for (GazeEvent& event : back) {
        const TrackerTime start = event.start;
        event.start = mirrored(event.end);
        event.end = mirrored(start);
    }
    std::reverse(back.begin(), back.end());
    const EventAgreement fixations = agreement(Kind::fixation, detect(planted.samples), back);
    CHECK(fixations.f1() > 0.99);
    CHECK(fixations.median_onset_error_ms().value() <= 4.0);
    CHECK(fixations.median_offset_error_ms().value() <= 4.0);
}

TEST_CASE("noise below the thresholds makes no saccade, whatever the rate", "[unit]") {
    for (const double rate_hz : {60.0, 250.0, 500.0, 1000.0, 2000.0}) {
        CAPTURE(rate_hz);
        RandomStream random(3, "still eye", static_cast<std::uint64_t>(rate_hz));
        std::vector<GazeSample> samples;
        for (int n = 0; n < static_cast<int>(20.0 * rate_hz); ++n)
            samples.push_back({tracker_time(std::llround(1e6 * n / rate_hz)), Eye::right,
                               place(0.05 * random.normal(), 0.05 * random.normal()), 1.0f});
        CHECK(detect(samples).size() == 1);
    }
}
