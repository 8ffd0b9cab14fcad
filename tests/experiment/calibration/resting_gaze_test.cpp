/// When gaze rests: its place, its scatter, and what is no rest.
#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/calibration/resting_gaze.h"

using namespace overt;
using namespace std::chrono_literals;

namespace {

GazeSample sample_at(std::int64_t us, std::optional<ScreenPoint> gaze) {
    GazeSample sample;
    sample.sampled_at = tracker_time(us);
    sample.gaze = gaze;
    return sample;
}

} // namespace

TEST_CASE("gaze that rests is told with its place and scatter", "[unit]") {
    RestingGaze resting(ScreenGeometry{}, {200ms, Degrees{1.0}});
    RandomStream random(3, "gaze noise");
    const double sd_deg = 0.05, sd_px = sd_deg * ScreenGeometry{}.px_per_deg_at_centre();
    CHECK_FALSE(resting.rested());
    for (int i = 0; i < 2000; ++i)
        resting.take(sample_at(
            500 * i, ScreenPoint{700.0 + sd_px * random.normal(), 300.0 + sd_px * random.normal()}));
    const std::optional<RestedGaze> rested = resting.rested();
    REQUIRE(rested);
    CHECK(rested->samples == 201); // of the last 100 ms at 2000 Hz, both ends
    CHECK(rested->median.x_px == Approx(700.0).margin(0.3 * sd_px));
    CHECK(rested->median.y_px == Approx(300.0).margin(0.3 * sd_px));
    // Independent noise of both axes: sd adds up in squares, and successive samples differ by twice that.
    CHECK(rested->sd.value == Approx(sd_deg * std::sqrt(2.0)).epsilon(0.1));
    CHECK(rested->rms_s2s.value == Approx(sd_deg * 2.0).epsilon(0.1));
}

TEST_CASE("gaze does not rest before the window has passed, while it moves, or behind a lid", "[unit]") {
    RestingGaze resting(ScreenGeometry{}, {100ms, Degrees{0.5}});
    for (int i = 0; i < 100; ++i) {
        resting.take(sample_at(1000 * i, ScreenPoint{100.0, 100.0}));
        CHECK_FALSE(resting.rested());
    }
    resting.take(sample_at(100'000, ScreenPoint{100.0, 100.0}));
    CHECK(resting.rested());
    // A saccade of two degrees: not until 98 of 100 samples lie beside each other again.
    const double away = 2.0 * ScreenGeometry{}.px_per_deg_at_centre();
    for (int i = 101; i < 199; ++i) {
        resting.take(sample_at(1000 * i, ScreenPoint{100.0 + away, 100.0}));
        if (i > 104 && i < 197)
            CHECK_FALSE(resting.rested());
    }
    for (int i = 199; i < 220; ++i)
        resting.take(sample_at(1000 * i, ScreenPoint{100.0 + away, 100.0}));
    REQUIRE(resting.rested());
    CHECK(resting.rested()->median.x_px == Approx(100.0 + away));
    // A quarter of the samples without gaze is too many.
    for (int i = 220; i < 400; ++i)
        resting.take(sample_at(1000 * i, i % 4 == 0 ? std::nullopt : std::optional(ScreenPoint{5.0, 5.0})));
    CHECK_FALSE(resting.rested());
    // A clock that went back begins anew.
    resting.take(sample_at(10, ScreenPoint{5.0, 5.0}));
    CHECK_FALSE(resting.rested());
}
