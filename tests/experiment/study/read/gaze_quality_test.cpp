/// Data quality from samples whose noise is known.
#include "experiment/study/read/gaze_quality.h"

#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;
using namespace std::chrono_literals;

namespace {

const ScreenGeometry screen;

std::vector<PlacedSample> samples_at(double rate_hz, int count) {
    std::vector<PlacedSample> samples(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        PlacedSample& sample = samples[static_cast<std::size_t>(i)];
        sample.sampled_at = TrackerTime(std::chrono::microseconds(std::llround(1e6 * i / rate_hz)));
        sample.gaze = screen.centre();
        sample.has_gaze = sample.has_time = true;
    }
    return samples;
}

GazeEvent event_of(GazeEvent::Kind kind, const std::vector<PlacedSample>& samples, int first, int last) {
    GazeEvent event;
    event.kind = kind;
    event.start = samples[static_cast<std::size_t>(first)].sampled_at;
    event.end = samples[static_cast<std::size_t>(last)].sampled_at;
    return event;
}

} // namespace

TEST_CASE("white noise of s degrees along each axis has an RMS-S2S of 2 s and an SD of root 2 s", "[unit]") {
    std::vector<PlacedSample> samples = samples_at(1000.0, 20'000);
    RandomStream random(4, "gaze noise");
    constexpr double noise_deg = 0.1;
    for (PlacedSample& sample : samples) {
        sample.gaze.x_px += noise_deg * screen.px_per_deg_at_centre() * random.normal();
        sample.gaze.y_px += noise_deg * screen.px_per_deg_at_centre() * random.normal();
    }
    const std::array events{event_of(GazeEvent::Kind::fixation, samples, 0, 19'999)};
    const StudyQuality quality = gaze_quality(samples, events, screen);
    // Pixels of this screen are 0.02 % wider than high.
    CHECK(*quality.rms_s2s_deg == Approx(2.0 * noise_deg).epsilon(0.02));
    CHECK(*quality.sd_deg == Approx(std::sqrt(2.0) * noise_deg).epsilon(0.02));
    CHECK(*quality.rate_hz == Approx(1000.0));
    CHECK(quality.samples == 20'000);
    CHECK(quality.lost == 0.0);
}

TEST_CASE("precision is the median over fixations of five samples and more, and not of the way between them",
          "[unit]") {
    std::vector<PlacedSample> samples = samples_at(500.0, 60);
    const double px = screen.px_per_deg_at_centre();
    // To and fro by 0.1, 0.3 and 0.2 degrees, 5 degrees apart; four samples at the end go 3 degrees each.
    const std::array steps_deg{0.1, 0.3, 0.2};
    for (int i = 0; i < 60; ++i) {
        double& x = samples[static_cast<std::size_t>(i)].gaze.x_px;
        x += i < 48 ? px * (5.0 * static_cast<int>(i / 16 - 1) +
                            (i % 2) * steps_deg[static_cast<std::size_t>(i / 16)])
                    : px * 3.0 * (i % 2);
    }
    const std::array events{event_of(GazeEvent::Kind::fixation, samples, 0, 15),
                            event_of(GazeEvent::Kind::fixation, samples, 16, 31),
                            event_of(GazeEvent::Kind::fixation, samples, 32, 47),
                            event_of(GazeEvent::Kind::fixation, samples, 50, 53),
                            event_of(GazeEvent::Kind::saccade, samples, 15, 16)};
    const StudyQuality quality = gaze_quality(samples, events, screen);
    CHECK(*quality.rms_s2s_deg == Approx(0.2).epsilon(0.01));
    // Half of the way to and fro, around a line through 16 samples.
    CHECK(*quality.sd_deg == Approx(0.1 * std::sqrt(16.0 / 14.0)).epsilon(0.01));
}

TEST_CASE("an eye that follows a turning object scatters as one that rests on a still one", "[unit]") {
    // A point of an object that turns by 25 degrees to each side in 2 s goes to and fro by up to 3 deg/s.
    const auto precision = [](double rate_hz, double speed_deg_s, double noise_deg) {
        constexpr double swing_s = 2.03;
        const int count = static_cast<int>(60.0 * rate_hz), of_one = static_cast<int>(0.8 * rate_hz);
        std::vector<PlacedSample> samples = samples_at(rate_hz, count);
        RandomStream random(6, "gaze noise");
        std::vector<GazeEvent> fixations;
        const double px = screen.px_per_deg_at_centre();
        for (int i = 0; i < count; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / (rate_hz * swing_s);
            const double way_deg = speed_deg_s * swing_s / (2.0 * std::numbers::pi) * std::sin(turn);
            ScreenPoint& gaze = samples[static_cast<std::size_t>(i)].gaze;
            gaze.x_px += px * (way_deg + noise_deg * random.normal());
            gaze.y_px += px * noise_deg * random.normal();
            if (i % of_one == 0 && i + of_one <= count)
                fixations.push_back(event_of(GazeEvent::Kind::fixation, samples, i, i + of_one - 1));
        }
        return gaze_quality(samples, fixations, screen);
    };
    const double rate_hz = GENERATE(60.0, 250.0, 1000.0);
    INFO(rate_hz << " Hz");
    const StudyQuality still = precision(rate_hz, 0.0, 0.05), turning = precision(rate_hz, 3.0, 0.05);
    // Planted: 0.05 degrees along both axes. The median of 75 fixations of n samples is known to 1.25 /
    // sqrt(75) of the scatter of one, 1 / sqrt(4 n).
    const double error = 3.0 * 1.25 / std::sqrt(75.0) / std::sqrt(4.0 * 0.8 * rate_hz) + 0.005;
    CHECK(*still.sd_deg == Approx(0.05 * std::sqrt(2.0)).epsilon(error));
    CHECK(*turning.sd_deg == Approx(0.05 * std::sqrt(2.0)).epsilon(error));
    // What the motion adds is small even where there is no noise to speak of.
    CHECK(*precision(rate_hz, 3.0, 0.001).sd_deg < 0.02);
    // Steps from sample to sample stay as they are: the motion is in them.
    CHECK(*turning.rms_s2s_deg > *still.rms_s2s_deg);
    CHECK(*turning.rms_s2s_deg < 1.03 * std::hypot(0.1, 3.0 / std::sqrt(2.0) / rate_hz));
}

TEST_CASE("lost samples are counted within blinks and apart from them", "[unit]") {
    std::vector<PlacedSample> samples = samples_at(1000.0, 1000);
    for (int i = 0; i < 1000; ++i)
        samples[static_cast<std::size_t>(i)].has_gaze = !((i >= 200 && i < 260) || (i >= 700 && i < 715));
    const std::array events{event_of(GazeEvent::Kind::blink, samples, 195, 265)};
    const StudyQuality quality = gaze_quality(samples, events, screen);
    CHECK(quality.blinks == 1);
    CHECK(quality.lost_in_blinks == 60);
    CHECK(quality.lost == 15);
    CHECK(quality.lost_share() == Approx(0.015));
    CHECK(quality.blink_share() == Approx(0.06));
    CHECK_FALSE(quality.rms_s2s_deg); // there is no fixation
}

TEST_CASE("what gaze does while samples are lost is no step from one sample to the next", "[unit]") {
    std::vector<PlacedSample> samples = samples_at(1000.0, 30);
    for (int i = 0; i < 30; ++i) {
        PlacedSample& sample = samples[static_cast<std::size_t>(i)];
        sample.has_gaze = i < 12 || i >= 15;
        sample.gaze.x_px += i < 15 ? 0.0 : 2.0 * screen.px_per_deg_at_centre();
    }
    const std::array events{event_of(GazeEvent::Kind::fixation, samples, 0, 29)};
    CHECK(*gaze_quality(samples, events, screen).rms_s2s_deg == Approx(0.0).margin(1e-9));
}

TEST_CASE("without a known distance there are no degrees, and without samples nothing", "[unit]") {
    std::vector<PlacedSample> samples = samples_at(250.0, 100);
    const std::array events{event_of(GazeEvent::Kind::fixation, samples, 0, 99)};
    ScreenGeometry unknown = screen;
    unknown.viewing_distance_mm = 0.0;
    const StudyQuality quality = gaze_quality(samples, events, unknown);
    CHECK_FALSE(quality.rms_s2s_deg);
    CHECK_FALSE(quality.sd_deg);
    CHECK(*quality.rate_hz == Approx(250.0));
    CHECK_FALSE(gaze_quality({}, {}, screen).rate_hz);
}

TEST_CASE("of several trials numbers add up, precisions have medians, accuracies a mean and a worst",
          "[unit]") {
    StudyQuality a, b, c;
    a.accuracy_deg = 0.3, a.worst_accuracy_deg = 0.6, a.rms_s2s_deg = 0.02, a.rate_hz = 1000.0;
    b.accuracy_deg = 0.6, b.worst_accuracy_deg = 0.9, b.rms_s2s_deg = 0.05, b.rate_hz = 500.0,
    b.sd_deg = 0.07;
    c.rms_s2s_deg = 0.03, c.rate_hz = 1000.0, c.drift_deg = 0.4;
    a.samples = 100, a.lost = 3, a.lost_in_blinks = 5, a.blinks = 1, a.refreshes = 960,
    a.missed_refreshes = 1;
    b.samples = 200, b.lost = 4, b.blinks = 2, b.refreshes = 960, b.off_plan = 7.0;
    const std::array trials{static_cast<const StudyQuality*>(&a), static_cast<const StudyQuality*>(&b),
                            static_cast<const StudyQuality*>(&c)};
    const StudyQuality all = quality_of_all(trials);
    CHECK(*all.accuracy_deg == Approx(0.45));
    CHECK(*all.worst_accuracy_deg == 0.9);
    CHECK(*all.rms_s2s_deg == 0.03);
    CHECK(*all.rate_hz == 1000.0);
    CHECK(*all.drift_deg == 0.4);
    CHECK(*all.sd_deg == 0.07);
    CHECK(all.samples == 300);
    CHECK(all.lost == 7);
    CHECK(all.lost_in_blinks == 5);
    CHECK(all.blinks == 3);
    CHECK(all.refreshes == 1920);
    CHECK(all.missed_refreshes == 1);
    CHECK(all.off_plan == 7.0);
}

TEST_CASE("two samples have a rate, and five in a fixation a precision", "[unit]") {
    CHECK(*gaze_quality(samples_at(250.0, 2), {}, screen).rate_hz == Approx(250.0));
    CHECK_FALSE(gaze_quality(samples_at(250.0, 1), {}, screen).rate_hz);
    CHECK(*gaze_quality(samples_at(1e6, 9), {}, screen).rate_hz == Approx(1e6));
    // All of one time have none.
    std::vector<PlacedSample> at_once(3);
    CHECK_FALSE(gaze_quality(at_once, {}, screen).rate_hz);
    std::vector<PlacedSample> samples = samples_at(250.0, 12);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].gaze.y_px += i % 2 == 0 ? 0.0 : 0.5 * screen.px_per_deg_at_centre();
    const auto precision = [&](int last) {
        return gaze_quality(samples, std::array{event_of(GazeEvent::Kind::fixation, samples, 3, last)},
                            screen);
    };
    CHECK_FALSE(precision(6).rms_s2s_deg);
    CHECK_FALSE(precision(6).sd_deg);
    CHECK(*precision(7).rms_s2s_deg == Approx(0.5).epsilon(0.01));
    // Ups and downs of 1/2 about a line through five: the squares about their mean are 0.3, none goes with
    // time.
    CHECK(*precision(7).sd_deg == Approx(std::sqrt(0.3 / 3.0)).epsilon(0.01));
    // With all of them lost but one in two there is no step from one to the next.
    for (std::size_t i = 0; i < samples.size(); i += 2)
        samples[i].has_gaze = false;
    CHECK_FALSE(precision(11).rms_s2s_deg);
}

TEST_CASE("scatter is about a line of its own in each fifth of a second", "[unit]") {
    // Gaze goes to the right for 0.2 s, down for as long, and back.
    std::vector<PlacedSample> samples = samples_at(100.0, 60);
    for (int i = 0; i < 60; ++i) {
        ScreenPoint& gaze = samples[static_cast<std::size_t>(i)].gaze;
        gaze.x_px += i < 20 ? 2.0 * i : i < 40 ? 60.0 : 120.0 - 3.0 * (i - 40);
        gaze.y_px += i < 20 ? 0.0 : i < 40 ? 1.0 * (i - 20) : 20.0;
    }
    const std::array events{event_of(GazeEvent::Kind::fixation, samples, 0, 59)};
    CHECK(*gaze_quality(samples, events, screen).sd_deg == Approx(0.0).margin(1e-6));
    // A stretch of fewer than five samples at the end is none.
    std::vector<PlacedSample> shorter(samples.begin(), samples.begin() + 43);
    for (std::size_t i = 40; i < 43; ++i)
        shorter[i].gaze.y_px += 40.0 * static_cast<double>(i);
    const std::array whole{event_of(GazeEvent::Kind::fixation, shorter, 0, 42)};
    CHECK(*gaze_quality(shorter, whole, screen).sd_deg == Approx(0.0).margin(1e-6));
    // To and fro by a quarter of a degree to each side: 20 samples to a line, of which two are its own.
    for (int i = 0; i < 60; ++i)
        samples[static_cast<std::size_t>(i)].gaze = {screen.centre().x_px + 0.25 * (i % 2 == 0 ? 1.0 : -1.0) *
                                                                                screen.px_per_deg_at_centre(),
                                                     screen.centre().y_px};
    CHECK(*gaze_quality(samples, events, screen).sd_deg ==
          Approx(std::sqrt((1.25 - 6.25 / 665.0) / 18.0)).epsilon(1e-6));
}

TEST_CASE("blinks take as many lost samples as there are, and nothing that was seen", "[unit]") {
    std::vector<PlacedSample> samples = samples_at(1000.0, 100);
    for (std::size_t i = 40; i < 50; ++i)
        samples[i].has_gaze = false;
    // Two events on the same samples, as of two eyes.
    const std::array events{event_of(GazeEvent::Kind::blink, samples, 38, 55),
                            event_of(GazeEvent::Kind::blink, samples, 40, 49),
                            event_of(GazeEvent::Kind::saccade, samples, 40, 49)};
    const StudyQuality quality = gaze_quality(samples, events, screen);
    CHECK(quality.blinks == 2);
    CHECK(quality.lost_in_blinks == 10);
    CHECK(quality.lost == 0);
    // Missed refreshes of all are not known where those of one are not.
    StudyQuality known, unknown;
    known.missed_refreshes = 3;
    unknown.missed_refreshes.reset();
    CHECK(quality_of_all(std::array<const StudyQuality*, 2>{&known, &known}).missed_refreshes == 6);
    CHECK_FALSE(
        quality_of_all(std::array<const StudyQuality*, 3>{&known, &unknown, &known}).missed_refreshes);
}
