#include "devices/lsl/lsl_inlet.h"

#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/lsl/lsl_bench.h"
#include "tests/support/kept_items.h"
#include "tests/support/still_setup_screen.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// A stream that is fed by a thread at about 250 Hz, as a tracker's program does, with a clock of its own.
struct FedStream {
    LslBench bench;
    std::shared_ptr<FakeStream> stream = bench.add_gaze("tracker");
    LslInletSettings settings;
    TrackerWish wish;
    KeptItems items;
    std::unique_ptr<LslInlet> inlet;
    std::jthread program{[this](const std::stop_token& stop) {
        for (int i = 0; !stop.stop_requested(); ++i) {
            bench.fake().feed(*stream, 1000.0 + 0.004 * i, {0.25, 0.75, 3.0, 0.5, 0.5, 4.0, 0.9});
            std::this_thread::sleep_for(1ms);
        }
    }};

    FedStream() {
        settings.library = LslBench::library();
        settings.patience = 20s;
        wish.both_eyes = true;
    }

    TrackerDescription connect() {
        inlet = std::make_unique<LslInlet>(settings, bench.clock);
        return inlet->connect(wish);
    }

    RecordingState read_samples(std::size_t wanted) {
        RecordingState state = RecordingState::running;
        const SessionTime give_up = bench.clock.now() + 60s;
        while (items.all<GazeSample>().size() < wanted && state == RecordingState::running &&
               bench.clock.now() < give_up)
            state = inlet->read(items, bench.clock.now() + 2ms);
        return state;
    }
};

} // namespace

TEST_CASE("a stream of gaze is found by its type and tells what it is", "[unit]") {
    FedStream fed;
    const TrackerDescription description = fed.connect();
    CHECK(description.name == "Lab Streaming Layer");
    CHECK(description.model == "\"tracker\" on tracker-pc, source serial 7, liblsl 116");
    CHECK(description.both_eyes);
    // 250 samples in a second of the stream's own clock, however fast they come.
    CHECK(description.sample_rate_hz == Approx(250.0).epsilon(0.01));
    CHECK(description.told_rate_hz == 0.0);
}

TEST_CASE("a stream's rate is what comes of it, and what it says is told beside it", "[unit]") {
    FedStream fed;
    fed.stream->rate_hz = 1000.0;
    const TrackerDescription description = fed.connect();
    CHECK(description.sample_rate_hz == Approx(250.0).epsilon(0.01));
    CHECK(description.told_rate_hz == 1000.0);
}

TEST_CASE("a stream whose own program has calibrated is set up, which is said", "[unit]") {
    FedStream fed;
    fed.connect();
    StillSetupScreen screen;
    const SetupOutcome outcome = fed.inlet->set_up(screen);
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    CHECK_FALSE(outcome.validation); // it tells no error
    CHECK_THAT(outcome.method, Contains("the tracker's own program, before the session"));
}

TEST_CASE("a stream of gaze is told by whatever its program calls its type", "[unit]") {
    FedStream fed;
    const auto markers = fed.bench.add_gaze("other");
    markers->type = "Markers";
    for (const char* type : {"gaze", "EyeTracking", "Eyetracker", "ET", "Eye-Tracking"}) {
        fed.stream->type = type;
        INFO(type);
        CHECK_THAT(fed.connect().model, Contains("\"tracker\" on tracker-pc"));
    }
    CHECK_FALSE(is_lsl_type_of_gaze("EEG"));
    CHECK_FALSE(is_lsl_type_of_gaze(""));
}

TEST_CASE("of two streams of one name none is taken silently, and each can be told by what is its own",
          "[unit]") {
    FedStream fed;
    fed.stream->uid = "uid-1";
    const auto twin = fed.bench.add_gaze("tracker");
    twin->source = "serial 8";
    twin->host = "lab2";
    twin->uid = "uid-2";
    fed.settings.stream = parse_lsl_choice("tracker");
    CHECK_THROWS_WITH(fed.connect(), Contains("2 streams could be meant") &&
                                         Contains("on tracker-pc, source_id=serial 7, uid=uid-1") &&
                                         Contains("on lab2, source_id=serial 8, uid=uid-2"));
    for (const char* one : {"source_id=serial 7", "uid=uid-1", "host=tracker-pc",
                            "name=tracker, source_id = serial 7", "type=Gaze, host=tracker-pc"}) {
        fed.settings.stream = parse_lsl_choice(one);
        INFO(one);
        CHECK_THAT(fed.connect().model, Contains("source serial 7"));
    }
    fed.settings.patience = 100ms;
    fed.settings.stream = parse_lsl_choice("name=tracker, host=lab3");
    CHECK_THROWS_WITH(fed.connect(), Contains("No stream of name \"tracker\" and host \"lab3\""));
    CHECK_THROWS_WITH(parse_lsl_choice("serial=7"), Contains("words are uid, source_id, name, host"));
    CHECK_THROWS_WITH(parse_lsl_choice("name=a, b"), Contains("does not say which stream"));
    CHECK(parse_lsl_choice("name=a=b").name == "a=b");
    CHECK(parse_lsl_choice("").is_open());
}

TEST_CASE("of two streams none is taken silently where a search misses one of them", "[unit]") {
    FedStream fed;
    fed.bench.add_gaze("tracker")->unheard = 1;
    for (const char* choice : {"tracker", "type=Gaze", ""}) {
        fed.settings.stream = parse_lsl_choice(choice);
        INFO(choice);
        CHECK_THROWS_WITH(fed.connect(), Contains("2 streams could be meant"));
        fed.bench.fake().network.back()->unheard = 1;
    }
}

TEST_CASE("a stream that is told by more than one thing is found behind others that have one of them",
          "[unit]") {
    FedStream fed;
    for (const char* other : {"EEG", "markers", "keys"}) {
        const auto stream = fed.bench.add_gaze(other);
        stream->type = other;
        fed.bench.fake().network.reverse(); // it answers first
    }
    fed.settings.patience = 100ms;
    fed.settings.stream = parse_lsl_choice("host=tracker-pc, type=Gaze");
    CHECK_THAT(fed.connect().model, Contains("\"tracker\" on tracker-pc"));
}

TEST_CASE("samples of a stream keep their own times, each once and in order", "[unit]") {
    FedStream fed;
    fed.connect();
    fed.inlet->start();
    REQUIRE(fed.read_samples(200) == RecordingState::running);
    fed.inlet->stop();
    const auto samples = fed.items.all<GazeSample>();
    for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
        CHECK(samples[i].gaze == ScreenPoint{480.0, 810.0});
        CHECK(samples[i + 1].gaze == ScreenPoint{960.0, 540.0});
        CHECK(samples[i + 1].pupil_area == 4.0f);
        if (i > 0)
            CHECK((samples[i].sampled_at - samples[i - 2].sampled_at).count() == 4000);
    }
    CHECK(fed.items.all<SampleDetail>().front().confidence == 0.9f);
    CHECK(fed.items.all<TrackerGap>().empty());
}

TEST_CASE("what a stream sends between recordings is no part of the next", "[unit][waits]") {
    FedStream fed;
    fed.connect();
    fed.inlet->start();
    fed.read_samples(2);
    fed.inlet->stop();
    const TrackerTime last = fed.items.all<GazeSample>().back().sampled_at;
    fed.bench.clock.wait_until(fed.bench.clock.now() + 200ms);
    fed.items.items.clear();
    fed.program = {}; // all that it sent waits now
    fed.inlet->start();
    fed.inlet->read(fed.items, SessionTime());
    CHECK(fed.items.items.empty());
    fed.bench.fake().feed(*fed.stream, 5000.0, std::vector<double>(7, 0.5));
    fed.inlet->read(fed.items, SessionTime());
    REQUIRE(fed.items.all<GazeSample>().size() == 2);
    CHECK(fed.items.all<GazeSample>().front().sampled_at > last);
}

TEST_CASE("readings of a stream's clock hold the truth between them", "[unit]") {
    FedStream fed;
    fed.settings.library = GENERATE(std::string(OVERT_FAKE_LIBLSL), std::string(OVERT_FAKE_LIBLSL_OLD));
    FakeLsl* (*find)() = nullptr;
    const SharedLibrary library({fed.settings.library}, "", "");
    library.find(find, "fake_lsl");
    if (find() != &fed.bench.fake()) {
        find()->network = {fed.stream};
        fed.program = {}; // it feeds the other library
        fed.program = std::jthread([&fed, find](const std::stop_token& stop) {
            for (int i = 0; !stop.stop_requested(); ++i) {
                find()->feed(*fed.stream, 1000.0 + 0.004 * i, std::vector<double>(7, 0.5));
                std::this_thread::sleep_for(1ms);
            }
        });
    }
    fed.stream->correction_s = -4321.5; // the stream's clock is ahead of ours
    fed.connect();
    const auto pair = fed.inlet->read_clocks();
    REQUIRE(pair);
    // Both clocks are this machine's monotonic one here.
    const double ours_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    const double truth_s = static_cast<double>(pair->other.time_since_epoch().count()) * 1e-6 - 4321.5 -
                           ours_s + to_seconds(fed.bench.clock.now());
    CHECK(to_seconds(pair->before) <= truth_s + 1e-5);
    CHECK(truth_s <= to_seconds(pair->after) + 1e-3); // between the two readings just above
    CHECK(pair->after - pair->before >= 400us);
    fed.stream->is_lost = true;
    CHECK_FALSE(fed.inlet->read_clocks());
    fed.program = {};
}

TEST_CASE("a stream that is lost or falls silent is lost, with a gap, and can be reached again", "[unit]") {
    FedStream fed;
    fed.stream->rate_hz = 250.0;
    fed.settings.silence = 200ms;
    fed.connect();
    fed.inlet->start();
    REQUIRE(fed.read_samples(20) == RecordingState::running);
    SECTION("lost") { fed.stream->is_lost = true; }
    SECTION("silent") { fed.program = {}; }
    CHECK(fed.read_samples(1'000'000) == RecordingState::lost);
    CHECK(fed.items.all<TrackerGap>().back().reason == TrackerGap::Reason::connection);
    CHECK(fed.items.all<TrackerGap>().back().after == fed.items.all<GazeSample>().back().sampled_at);
    fed.inlet->stop();
    if (fed.stream->is_lost) {
        CHECK_THROWS_WITH(fed.inlet->start(), Contains("\"tracker\" is gone"));
        fed.stream->is_lost = false;
        CHECK(fed.inlet->connect(fed.wish).both_eyes);
    }
}

TEST_CASE("streams that are not there, not one or not gaze are refused with a remedy", "[unit]") {
    FedStream fed;
    const auto second = fed.bench.add_gaze("second");
    fed.settings.patience = 100ms;
    CHECK_THROWS_WITH(fed.connect(), Contains("2 streams could be meant:\n  \"tracker\" of type Gaze") &&
                                         Contains("\"second\""));
    fed.settings.stream.name = "third";
    CHECK_THROWS_WITH(fed.connect(), Contains("No stream of name \"third\"") && Contains("16571"));
    fed.settings.stream.name = "second";
    CHECK_THROWS_WITH(fed.connect(), Contains("\"second\" sends nothing"));
    second->answers = false;
    CHECK_THROWS_WITH(fed.connect(), Contains("does not tell what is in it"));
    second->format = 3;
    CHECK_THROWS_WITH(fed.connect(), Contains("carries no numbers"));
    fed.settings.stream.name = "tracker";
    fed.settings.patience = 20s;
    CHECK_NOTHROW(fed.connect());
    fed.inlet.reset();
    CHECK(fed.bench.fake().infos == 0);
    CHECK(fed.bench.fake().inlets == 0);
}

TEST_CASE("without liblsl, or with one that lacks functions, it is said what to do", "[unit]") {
    CHECK_THROWS_WITH(load_lsl("/nowhere/liblsl.so"),
                      Contains("/nowhere/liblsl.so: cannot open shared object") &&
                          Contains("OVERT_LSL_LIBRARY"));
    CHECK_THROWS_WITH(load_lsl(OVERT_FAKE_LIBLSL_BROKEN), Contains("it lacks lsl_resolve_byprop;"));
    const VendorLibrary of_home{"home", "a library", "HOME", {"b", "c"}},
        of_nothing{"none", "a library", "OVERT_NO_SUCH_VARIABLE", {"b", "c"}};
    CHECK(library_candidates("a", of_home) == std::vector<std::string>{"a"});
    CHECK(library_candidates("", of_home).front() != "b");
    CHECK(library_candidates("", of_nothing) == std::vector<std::string>{"b", "c"});
}
