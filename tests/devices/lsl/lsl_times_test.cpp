/// What tells a stream, how long one may be silent, and how wide a reading of its clock is.
#include <cmath>

#include <catch2/catch.hpp>

#include "devices/lsl/lsl_inlet.h"
#include "devices/lsl/lsl_stream_search.h"
#include "experiment/base/error.h"
#include "tests/devices/lsl/lsl_bench.h"
#include "tests/support/counted_clock.h"
#include "tests/support/kept_items.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct TimedStream {
    LslBench bench;
    CountedClock clock;
    LslInletSettings settings;
    TrackerWish wish;
    KeptItems kept;
    std::shared_ptr<FakeStream> stream = bench.add_gaze("tracker");
    std::optional<LslInlet> inlet;

    /// Each reading of the clock takes a millisecond while it is connected; a sample each 4 ms waits.
    TrackerDescription connect(double nominal_hz) {
        settings.library = LslBench::library();
        stream->rate_hz = nominal_hz;
        stream->is_open = true;
        for (int i = 0; i < 200; ++i)
            feed(1000.0 + 0.004 * i);
        settings.patience = 100ms;
        settings.stream.uid = stream->uid;
        inlet.emplace(settings, clock);
        clock.reading = 1ms;
        const TrackerDescription told = inlet->connect(wish);
        inlet->start();
        clock.reading = {};
        stream->waiting.clear();
        return told;
    }
    void feed(double time_s) { bench.fake().feed(*stream, time_s, {0.25, 0.75, 3.0, 0.5, 0.5, 4.0, 0.9}); }
};

} // namespace

TEST_CASE("a stream is told by words and values between commas, or by its name alone", "[unit]") {
    LslStreamChoice choice = parse_lsl_choice("My tracker, left");
    CHECK(choice.name == "My tracker, left");
    choice = parse_lsl_choice(" source_id = a b , host=pc,  type= Gaze,uid=u,name=n=m ");
    CHECK(choice.source_id == "a b");
    CHECK(choice.host == "pc");
    CHECK(choice.type == "Gaze");
    CHECK(choice.uid == "u");
    CHECK(choice.name == "n=m");
    CHECK(parse_lsl_choice("").is_open());
    CHECK_FALSE(parse_lsl_choice("host=pc").is_open());
    for (const char* const wrong : {"host=pc, b", "color=red", "=x", "host=pc,,name=x"})
        CHECK_THROWS_AS(parse_lsl_choice(wrong), InputError);
    for (const char* const type : {"Gaze", "gaze", "EyeTracking", "Eye-Tracker", "E.T.", "Eye Gaze"})
        CHECK(is_lsl_type_of_gaze(type));
    for (const char* const type : {"", "EEG", "Gazes", "Markers"})
        CHECK_FALSE(is_lsl_type_of_gaze(type));
}

TEST_CASE("a stream with a rate is lost after its silence, one without after a longer one", "[unit]") {
    for (const double rate_hz : {250.0, 0.0}) {
        TimedStream timed;
        const TrackerDescription told = timed.connect(rate_hz);
        CHECK(told.sample_rate_hz == Approx(250.0).epsilon(0.01));
        CHECK(told.told_rate_hz == rate_hz);
        timed.feed(2000.0);
        timed.feed(2000.004);
        CHECK(timed.inlet->read(timed.kept, timed.clock.time) == RecordingState::running);
        CHECK(timed.kept.all<GazeSample>().size() == 2);
        CHECK(timed.kept.all<GazeSample>()[1].sampled_at == tracker_time(2'000'004'000));
        const SessionDuration silence = rate_hz > 0.0 ? 2s : 10s;
        timed.clock.time += silence - 1ns;
        CHECK(timed.inlet->read(timed.kept, timed.clock.time) == RecordingState::running);
        timed.clock.time += 1ns;
        CHECK(timed.inlet->read(timed.kept, timed.clock.time) == RecordingState::lost);
        const auto gaps = timed.kept.all<TrackerGap>();
        REQUIRE(gaps.size() == 1);
        CHECK(gaps[0].after == tracker_time(2'000'004'000));
        CHECK(gaps[0].lost_samples == 0);
    }
}

TEST_CASE("a reading of a stream's clock is as wide as its uncertainty to both sides, and tells when it was",
          "[unit]") {
    TimedStream timed;
    timed.connect(250.0);
    timed.stream->correction_s = 50.0;
    timed.stream->uncertainty_s = 0.003;
    const auto pair = timed.inlet->read_clocks();
    REQUIRE(pair);
    CHECK(pair->after - pair->before == 6ms);
    // The stand-in measured it a second and a half ago.
    CHECK(to_seconds(timed.clock.time - pair->after) == Approx(1.497).margin(0.2));
    CHECK(1e-6 * static_cast<double>(pair->other.time_since_epoch().count()) ==
          Approx(load_lsl(LslBench::library())->local_clock() - 1.5 - 50.0).margin(0.5));
    timed.stream->uncertainty_s = 10.0;
    CHECK(timed.inlet->read_clocks());
    timed.stream->uncertainty_s = 10.001;
    CHECK_FALSE(timed.inlet->read_clocks());
    timed.stream->uncertainty_s = std::nan("");
    CHECK_FALSE(timed.inlet->read_clocks());
    timed.stream->uncertainty_s = 0.001;
    timed.stream->correction_s = std::nan("");
    CHECK_FALSE(timed.inlet->read_clocks());
}
