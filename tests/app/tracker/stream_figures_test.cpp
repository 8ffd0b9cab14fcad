/// What is said of a tracker's stream: rates, holes, repeated samples, clocks.
#include <catch2/catch.hpp>

#include "app/tracker/stream_figures.h"

using namespace overt;

namespace {

GazeSample at_us(std::int64_t us, Eye eye = Eye::right, bool has_gaze = true) {
    GazeSample sample;
    sample.sampled_at = tracker_time(us);
    sample.eye = eye;
    if (has_gaze)
        sample.gaze = ScreenPoint{1.0, 2.0};
    return sample;
}

} // namespace

TEST_CASE("a stream's rate, holes and repeated samples are counted, each eye for itself", "[unit]") {
    StreamFigures figures;
    CHECK_FALSE(figures.rate_hz(Eye::left));
    for (int i = 0; i <= 1000; ++i) {
        if (i == 500 || i == 501)
            continue; // two are missing
        figures.take(at_us(500 * i, Eye::left, i % 10 != 0));
        figures.take(at_us(500 * i, Eye::right));
    }
    figures.take(at_us(500'000, Eye::right)); // again
    figures.take(at_us(499'000, Eye::right)); // back
    figures.take(TrackerGap{});
    figures.take(TrackerEvent{});
    CHECK(figures.rate_hz(Eye::left).value() == Approx(2000.0 * 998.0 / 1000.0));
    CHECK(figures.samples() == 2 * 999 + 2);
    CHECK(figures.without_gaze() == 100);
    CHECK(figures.holes(Eye::left) == 1);
    CHECK(figures.longest_interval_ms(Eye::left) == Approx(1.5));
    CHECK(figures.repeated() == 1);
    CHECK(figures.out_of_order() == 1);
    CHECK(figures.gaps() == 1);
    CHECK(figures.events() == 1);
    CHECK_FALSE(figures.clock());
    CHECK_FALSE(figures.best_half_trip_us());
}

TEST_CASE("clock readings in the stream and beside it make one map", "[unit]") {
    StreamFigures figures;
    const auto pair_at = [](double s, double trip_us) {
        const SessionTime at{from_seconds(s)};
        return ClockPair{at, tracker_time(static_cast<std::int64_t>(1e6 * (1.0 + 50e-6) * s)),
                         at + from_seconds(1e-6 * trip_us)};
    };
    figures.take(pair_at(0.0, 300.0));
    figures.take(TrackerItem(pair_at(50.0, 100.0)));
    figures.take(pair_at(100.0, 200.0));
    REQUIRE(figures.clock());
    CHECK(figures.clock()->drift_ppm() == Approx(-50.0).margin(figures.clock()->drift_uncertainty_ppm()));
    CHECK(*figures.best_half_trip_us() == Approx(50.0));
}
