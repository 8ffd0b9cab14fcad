#include "devices/tracker/sample_rate_watch.h"

#include <catch2/catch.hpp>

using namespace overt;
using Catch::Matchers::Contains;

namespace {

void record(SampleRateWatch& watch, std::int64_t from_us, std::int64_t interval_us, int count) {
    watch.begin();
    GazeSample sample;
    for (int i = 0; i < count; ++i) {
        sample.sampled_at = tracker_time(from_us + interval_us * i);
        for (const Eye eye : {Eye::left, Eye::right}) {
            sample.eye = eye;
            watch.take(sample);
        }
    }
}

TrackerDescription granted(double rate_hz) { return {"any", rate_hz, Eye::right, true}; }

} // namespace

TEST_CASE("a rate is that of measurements, of both eyes and without the time between recordings", "[unit]") {
    SampleRateWatch watch;
    CHECK_FALSE(watch.rate_hz());
    record(watch, 1'000'000, 4000, 200);
    CHECK_FALSE(watch.rate_hz()); // 0.8 s
    record(watch, 90'000'000, 4000, 200);
    REQUIRE(watch.rate_hz());
    CHECK(*watch.rate_hz() == Approx(250.0));
    CHECK_FALSE(watch.warning(granted(250.0)));
    CHECK_FALSE(watch.warning(granted(254.0)));
    CHECK_FALSE(watch.warning(granted(0.0))); // none was granted
}

TEST_CASE("60 samples a second where 250 were granted are told", "[unit]") {
    SampleRateWatch watch;
    record(watch, 0, 16'667, 120);
    REQUIRE(watch.warning(granted(250.0)));
    CHECK_THAT(*watch.warning(granted(250.0)), Contains("59.999 samples came") && Contains("not 250"));
    // One that comes again, or out of order, is no further one.
    SampleRateWatch twice;
    twice.begin();
    GazeSample sample;
    for (int i = 0; i < 300; ++i)
        for (const int back_us : {0, 0, 3000}) {
            sample.sampled_at = tracker_time(4000 * i - back_us);
            twice.take(sample);
        }
    CHECK(*twice.rate_hz() == Approx(250.0));
}

TEST_CASE("a rate is known from a second on", "[unit]") {
    SampleRateWatch shorter, exact;
    record(shorter, 0, 9'999, 101);
    CHECK_FALSE(shorter.rate_hz());
    record(exact, 0, 10'000, 101);
    CHECK(exact.rate_hz() == Approx(100.0));
}
