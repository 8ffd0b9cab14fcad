/// The thresholds of a recording: by its rate and its noise, and by what was chosen.
#include "experiment/events/event_thresholds.h"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/events/recording_events.h"
#include "tests/experiment/events/detected_events.h"
#include "tests/experiment/events/gaze_trace.h"

using namespace overt;
using namespace overt::testing;
using Kind = GazeEvent::Kind;

namespace {

std::optional<GazeNoise> measured(const std::vector<GazeSample>& samples) {
    GazeNoiseMeter meter{GazeAngles(screen)};
    for (const GazeSample& sample : samples)
        meter.push(sample);
    meter.finish();
    return meter.measured();
}

std::vector<GazeSample> noisy_rest(double rate_hz, double seconds, double noise_deg) {
    Trace trace(rate_hz);
    trace.rest(seconds, 1.0);
    RandomStream random(3, "gaze noise");
    for (GazeSample& sample : trace.samples)
        sample.gaze = place(1.0 + noise_deg * random.normal(), noise_deg * random.normal());
    return trace.samples;
}

std::vector<GazeEvent> found_in(const std::vector<GazeSample>& samples, const ChosenThresholds& chosen = {}) {
    const ReadGaze read = [&](const TakeGaze& take) { take(samples, true); };
    const GazeAngles by_screen(screen);
    EventList list;
    find_events(read, by_screen, thresholds_for(read, by_screen, chosen).settings, list);
    return list.events;
}

} // namespace

TEST_CASE("rate and noise of gaze are measured as they were planted", "[unit]") {
    const double rate_hz = GENERATE(250.0, 500.0, 1000.0);
    CAPTURE(rate_hz);
    constexpr double noise_deg = 0.04;
    const std::optional<GazeNoise> noise = measured(noisy_rest(rate_hz, 40.0, noise_deg));
    REQUIRE(noise);
    CHECK(noise->interval_ms == Approx(1e3 / rate_hz).epsilon(0.01));
    // The slope of a line through samples at these times has this scatter along each axis, and the length of
    // two such has the median of a Rayleigh distribution.
    double squares_s2 = 0.0;
    for (int i = 1; 1e3 * i / rate_hz <= velocity_window_ms; ++i)
        squares_s2 += 2.0 * std::pow(i / rate_hz, 2);
    CHECK(noise->speed_deg_s ==
          Approx(std::sqrt(2.0 * std::log(2.0)) * noise_deg / std::sqrt(squares_s2)).epsilon(0.03));
    // What is lost, and the jump across a gap, is no noise.
    Trace trace(rate_hz);
    trace.rest(5.0, 1.0).lose(2.0).skip(1.0).rest(5.0, 6.0);
    CHECK(measured(trace.samples)->speed_deg_s == Approx(0.0).margin(0.05));
    CHECK_FALSE(measured({}));
}

TEST_CASE("thresholds go with rate and noise, and what was chosen stands", "[unit]") {
    const EventSettings calm = usual_settings({2.0, 3.0}), noisy = usual_settings({2.0, 20.0}),
                        slow = usual_settings({1e3 / 60.0, 3.0});
    CHECK(usual_settings({0.5, 3.0}) == calm);
    CHECK(noisy.velocity_deg_s > calm.velocity_deg_s);
    CHECK(usual_settings({2.0, 8.0}).velocity_deg_s < calm.velocity_deg_s);
    CHECK(noisy.acceleration_deg_s2 > 2.0 * calm.acceleration_deg_s2);
    CHECK(slow.velocity_deg_s < 0.5 * calm.velocity_deg_s);
    ChosenThresholds chosen;
    chosen.values[0] = 22.0;
    CHECK(chosen.over(noisy).velocity_deg_s == 22.0);
    CHECK(chosen.over(noisy).acceleration_deg_s2 == noisy.acceleration_deg_s2);
    // The record tells all of them, and what they come from.
    const EventDetection detection = detection_by(calm, GazeNoise{2.0, 3.0});
    for (const EventThreshold& threshold : event_thresholds)
        CHECK_THAT(detection.parameters, Catch::Matchers::Contains(fmt::format("\"{}\":{},", threshold.key,
                                                                               calm.*threshold.setting)));
    CHECK_THAT(detection.parameters,
               Catch::Matchers::Contains("\"measured_interval_ms\":2,\"measured_speed_deg_s\":3}"));
}

TEST_CASE("noisy gaze makes no saccades of its own, and slow gaze shows those that are there", "[unit]") {
    const auto [rate_hz, noise_deg, least_f1] =
        GENERATE(std::tuple(250.0, 0.15, 0.85), std::tuple(60.0, 0.05, 0.97), std::tuple(120.0, 0.05, 0.98),
                 std::tuple(500.0, 0.02, 0.99), std::tuple(1000.0, 0.05, 0.99));
    CAPTURE(rate_hz, noise_deg);
    const PlantedGaze planted =
        plant_gaze({.rate_hz = rate_hz, .duration_s = 60.0, .noise_deg = noise_deg}, screen);
    const std::vector<GazeEvent> found = found_in(planted.samples);
    CHECK(agreement(Kind::fixation, planted.events, found).f1() >= least_f1);
    // By thresholds that do not go with the gaze more or less is found.
    const double fixed = agreement(Kind::fixation, planted.events, detect(planted.samples)).f1();
    CHECK(agreement(Kind::fixation, planted.events, found).f1() >= fixed);
    if (noise_deg > 0.1)
        CHECK(fixed < 0.7);
}
