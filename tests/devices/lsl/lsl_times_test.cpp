/// What tells a stream, how long one may be silent, and how wide a reading of its clock is.
#include <cmath>
#include <cstdlib>
#include <thread>

#include <catch2/catch.hpp>

#include "devices/lsl/lsl_inlet.h"
#include "devices/lsl/lsl_outlet.h"
#include "devices/lsl/lsl_stream_search.h"
#include "experiment/base/error.h"
#include "tests/devices/lsl/lsl_bench.h"
#include "tests/devices/tracker/row_parts.h"
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

TEST_CASE("what is asked of liblsl to receive a stream, with how long it may take", "[unit]") {
    TimedStream timed;
    timed.stream->uid = "u7";
    const TrackerDescription told = timed.connect(250.0);
    CHECK(told.model == "\"tracker\" on tracker-pc, source serial 7, liblsl 116");
    std::vector<std::string> calls, pulls;
    for (const std::string& each : timed.bench.fake().asked)
        (each.starts_with("pull") ? pulls : calls).push_back(each);
    CHECK(calls == std::vector<std::string>{"resolve uid u7 1 0.1 256", "inlet 60 0 0", "full info 0.1",
                                            "open 0.1", "correction 0.1"});
    REQUIRE(pulls.size() > 10);
    // The first may take all the patience, and later ones what is left of it; what waits is not waited for.
    CHECK(pulls[0] == "pull 7 0.098");
    CHECK(pulls[1] == "pull 7 0.095");
    CHECK(pulls.back() == "pull 7 0");
    timed.bench.fake().asked.clear();
    timed.inlet->read(timed.kept, timed.clock.time + 30ms);
    timed.inlet->read(timed.kept, timed.clock.time - 30ms);
    CHECK(timed.bench.fake().asked == std::vector<std::string>{"pull 7 0.03", "pull 7 0"});
    timed.bench.fake().asked.clear();
    timed.feed(5000.0);
    timed.inlet->read(timed.kept, timed.clock.time + 30ms);
    CHECK(timed.bench.fake().asked == std::vector<std::string>{"pull 7 0.03", "pull 7 0"});
    timed.bench.fake().asked.clear();
    CHECK(timed.inlet->read_clocks());
    CHECK(timed.bench.fake().asked == std::vector<std::string>{"correction 0.5"});
    timed.stream->correction_error = -1;
    CHECK_FALSE(timed.inlet->read_clocks());
}

TEST_CASE("of a stream 4096 samples are taken at a time, and none that has no time", "[unit]") {
    TimedStream timed;
    timed.connect(250.0);
    for (int i = 0; i < 5000; ++i)
        timed.feed(2000.0 + 0.004 * i);
    timed.inlet->read(timed.kept, timed.clock.time);
    CHECK(timed.kept.all<GazeSample>().size() == 4096);
    timed.inlet->read(timed.kept, timed.clock.time);
    CHECK(timed.kept.all<GazeSample>().size() == 5000);
    for (const double none_s : {std::nan(""), 0.0}) {
        timed.feed(none_s);
        timed.feed(3000.0);
        timed.inlet->read(timed.kept, timed.clock.time);
        timed.inlet->read(timed.kept, timed.clock.time);
    }
    CHECK(timed.kept.all<GazeSample>().size() == 5002);
    // What came between recordings belongs to none, and its silence neither.
    for (int i = 0; i < 10; ++i)
        timed.feed(4000.0 + 0.004 * i);
    timed.clock.time += 100s;
    timed.inlet->start();
    CHECK(timed.inlet->read(timed.kept, timed.clock.time) == RecordingState::running);
    CHECK(timed.kept.all<GazeSample>().size() == 5002);
    timed.kept.items.clear();
    timed.clock.time += 2s;
    CHECK(timed.inlet->read(timed.kept, timed.clock.time) == RecordingState::lost);
    CHECK(timed.kept.all<TrackerGap>().at(0).after == TrackerTime());
}

TEST_CASE("streams that cannot be received are refused, and why", "[unit]") {
    const auto refused = [](auto change) {
        TimedStream timed;
        change(timed);
        std::string why;
        try {
            timed.connect(250.0);
        } catch (const DeviceError& error) {
            why = error.what();
        }
        timed.inlet.reset();
        CHECK(timed.bench.fake().infos == 0);
        CHECK(timed.bench.fake().inlets == 0);
        return why;
    };
    using Catch::Matchers::Contains;
    CHECK(refused([](TimedStream&) {}).empty());
    CHECK(refused([](TimedStream& timed) { timed.stream->format = 3; }) ==
          "The stream \"tracker\" carries no numbers that could be gaze (7 channels, format 3); name another "
          "stream.");
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->channels = 0; }), Contains("(0 channels"));
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->channels = 1025; }),
               Contains("(1025 channels"));
    CHECK_THAT(refused([](TimedStream& timed) {
                   timed.stream->channels = 1024;
                   timed.stream->answers = false;
               }),
               Contains("does not tell what is in it"));
    CHECK_THAT(refused([](TimedStream& timed) { timed.bench.fake().refused = "inlet"; }),
               Contains("cannot be connected to"));
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->answers = false; }),
               Contains("does not tell what is in it (error -1)"));
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->open_error = -1; }),
               Contains("no answer in time"));
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->open_error = -2; }), Contains("it is gone"));
    // More channels are described than there are, and fewer.
    CHECK_THAT(refused([](TimedStream& timed) { timed.stream->channels = 1; }),
               Contains("it has the channels 1 \"left_x\" (ScreenX). Name"));
    CHECK_THAT(refused([](TimedStream& timed) {
                   timed.stream->desc.children.front().children.resize(1);
                   timed.stream->channels = 2;
               }),
               Contains("it has the channels 1 \"left_x\" (ScreenX), 2 \"\" (no type)"));
}

TEST_CASE("a stream is looked for two seconds at a time, and again once one is found", "[unit]") {
    const LslBench bench;
    const auto library = load_lsl(LslBench::library());
    const auto looked = [&](const char* choice, SessionDuration patience) {
        bench.fake().asked.clear();
        std::string why;
        try {
            find_lsl_stream(*library, parse_lsl_choice(choice), patience);
        } catch (const DeviceError& error) {
            why = error.what();
        }
        std::string asked;
        for (const std::string& each : bench.fake().asked)
            asked += each + "; ";
        return asked + why.substr(0, why.find(';'));
    };
    const std::string none = " is on the network";
    CHECK(looked("", 5s) ==
          "resolve all 2 256; resolve all 2 256; resolve all 1 256; No stream of type Gaze (or "
          "EyeTracking, Eyetracker, ET)" +
              none);
    CHECK(looked("name=a", 500ms) == "resolve name a 2 0.5 256; No stream of name \"a\"" + none);
    CHECK(looked("host=h, type=t", 2s) ==
          "resolve hostname h 256 2 256; No stream of host \"h\" and type \"t\"" + none);
    CHECK(looked("type=t,source_id=s,uid=u,name=n", 1s) ==
          "resolve uid u 1 1 256; No stream of uid \"u\" and source_id \"s\" and name \"n\" and type \"t\"" +
              none);
    const auto stream = bench.add_gaze("a");
    stream->uid = "u";
    CHECK(looked("a", 5s) == "resolve name a 2 2 256; resolve name a 2 2 256; ");
    CHECK(looked("uid=u", 5s) == "resolve uid u 1 2 256; ");
    CHECK(looked("", 5s) == "resolve all 2 256; resolve all 2 256; ");
    stream->unheard = 1;
    CHECK(looked("a", 5s) == "resolve name a 2 2 256; resolve name a 2 2 256; resolve name a 2 2 256; ");
    // One that comes twice, by two addresses, is one.
    bench.fake().network.push_back(stream);
    CHECK(looked("a", 5s) == "resolve name a 2 2 256; resolve name a 2 2 256; ");
    bench.fake().network.pop_back();
    const auto other = bench.add_gaze("a");
    other->uid = "v";
    other->source = "";
    CHECK(
        looked("a", 5s) ==
        "resolve name a 2 2 256; 2 streams could be meant:\n  \"a\" of type Gaze on tracker-pc, "
        "source_id=serial "
        "7, uid=u\n  \"a\" of type Gaze on tracker-pc, source_id=(none), uid=v\nSay which with what tells it "
        "apart, such as address = \"source_id=…\" or \"uid=…\".");
    CHECK(bench.fake().infos == 0);
}

TEST_CASE("what is asked of liblsl to send a stream, and what becomes of a refusal", "[unit]") {
    LslBench bench;
    CountedClock clock;
    const auto library = load_lsl(LslBench::library());
    using Catch::Matchers::Contains;
    {
        LslMarkerOutlet outlet(library, "s 1", clock);
        CHECK(bench.fake().asked ==
              std::vector<std::string>{"info overt Markers 1 0 3 overt s 1", "outlet 0 360"});
        bench.fake().asked.clear();
        Marker marker;
        marker.at = clock.time - 1000s;
        marker.code = 255;
        const double before_s = library->local_clock();
        CHECK(outlet.send(marker));
        const double after_s = library->local_clock();
        CHECK(bench.fake().asked == std::vector<std::string>{"push 1"});
        const FakeStream::Pushed& pushed = bench.fake().sent.back()->pushed.back();
        CHECK(pushed.text == "255");
        CHECK(pushed.time_s >= before_s - 1000.0);
        CHECK(pushed.time_s <= after_s - 1000.0);
        const std::string long_text(longest_marker + 20, 'm');
        marker.text = long_text;
        bench.fake().refused = "push";
        CHECK_FALSE(outlet.send(marker));
        CHECK(bench.fake().sent.back()->pushed.back().text == std::string(longest_marker, 'm'));
    }
    for (const auto& [refused, why] :
         {std::pair("info", "\"overt\" of the Lab Streaming Layer cannot be made"),
          {"outlet", "\"overt\" of the Lab Streaming Layer cannot be opened"}}) {
        bench.fake().refused = refused;
        CHECK_THROWS_WITH(LslMarkerOutlet(library, "s", clock), Contains(why));
    }
    CHECK(bench.fake().infos == 0);
    CHECK(bench.fake().outlets == 0);
}

TEST_CASE("the row of streams takes from the protocol which it is and what its channels are", "[unit]") {
    const LslBench bench;
    const auto stream = bench.add_gaze("other");
    const auto meant = bench.add_gaze("meant");
    meant->correction_s = 0.0;
    setenv("OVERT_LSL_LIBRARY", LslBench::library().c_str(), 1);
    RowParts parts;
    parts.protocol.tracker.address = "name=meant";
    parts.protocol.tracker.channels = {"right x 2", "right y 1", "right confidence 7"};
    parts.protocol.tracker.unit = StreamUnit::percent;
    parts.protocol.tracker.y_is_up = true;
    parts.protocol.tracker.least_confidence = 0.5;
    parts.protocol.tracker.missing = {-1.0};
    const auto driver = parts.driver<kind_called<TrackerKind>("lsl")>();
    meant->is_open = true;
    std::jthread feeder([&](const std::stop_token& stop) {
        for (int i = 0; !stop.stop_requested(); ++i) {
            bench.fake().feed(*meant, 1000.0 + 0.01 * i,
                              {25.0, 50.0, 3.0, 0.5, 0.5, 4.0, i % 2 == 0 ? 0.5 : 0.4});
            parts.sitting.clock.wait_until(parts.sitting.clock.now() + 10ms);
            std::this_thread::sleep_for(1ms);
        }
    });
    const TrackerDescription told = driver->connect({});
    CHECK_THAT(told.model, Catch::StartsWith("\"meant\" on"));
    driver->start();
    KeptItems kept;
    for (int tries = 0; tries < 2000 && kept.all<GazeSample>().size() < 4; ++tries) {
        driver->read(kept, parts.sitting.clock.now());
        std::this_thread::sleep_for(1ms);
    }
    feeder = {};
    unsetenv("OVERT_LSL_LIBRARY");
    const auto samples = kept.all<GazeSample>();
    const auto details = kept.all<SampleDetail>();
    REQUIRE(samples.size() >= 4);
    REQUIRE(details.size() == samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool is_sure = *details[i].confidence >= 0.5f;
        REQUIRE(samples[i].gaze.has_value() == is_sure);
        if (is_sure) {
            CHECK(samples[i].gaze->x_px == Approx(960.0));
            CHECK(samples[i].gaze->y_px == Approx(0.75 * 1080.0));
        }
    }
    CHECK(tracker_device_of<kind_called<TrackerKind>("lsl")>().is_calibrated_elsewhere);
}

TEST_CASE(
    "where liblsl tells no uncertainty a reading of a stream's clock is a millisecond wide to each side",
    "[unit]") {
    FakeLsl* (*find)() = nullptr;
    SharedLibrary({OVERT_FAKE_LIBLSL_OLD}, "the stand-in", "").find(find, "fake_lsl");
    FakeLsl& fake = *find();
    const LslBench bench;
    const auto stream = bench.add_gaze("tracker");
    {
        const std::scoped_lock lock(fake.mutex);
        fake.network = {stream};
    }
    CountedClock clock;
    clock.reading = 1ms;
    LslInletSettings settings;
    settings.library = OVERT_FAKE_LIBLSL_OLD;
    settings.patience = 100ms;
    LslInlet inlet(settings, clock);
    stream->is_open = true;
    for (int i = 0; i < 200; ++i)
        fake.feed(*stream, 1000.0 + 0.004 * i, {0.25, 0.75, 3.0, 0.5, 0.5, 4.0, 0.9});
    inlet.connect({});
    clock.reading = {};
    const auto pair = inlet.read_clocks();
    REQUIRE(pair);
    CHECK(pair->after - pair->before == 2ms);
    const std::scoped_lock lock(fake.mutex);
    fake.network.clear();
}
