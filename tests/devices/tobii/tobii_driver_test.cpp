#include "devices/tobii/tobii_driver.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/tobii/tobii_bench.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

TEST_CASE("the only tracker of Tobii's is found, tells what it is and takes the nearest rate", "[unit]") {
    TobiiBench bench;
    const TrackerDescription told = bench.connect();
    CHECK(told.name == "tobii");
    CHECK(told.model == "Glass 9000 SER1, firmware 2.6, SDK 2.11.7");
    CHECK(told.both_eyes);
    // 600 Hz is nearest to 500, and is what it measures at already.
    CHECK(told.sample_rate_hz == 600.0);
    CHECK_FALSE(bench.library.heard("rate 600"));
    bench.wish.rate_hz = 1000.0;
    CHECK(bench.connect().sample_rate_hz == 1200.0);
    CHECK(bench.library.heard("rate 1200"));
    bench.wish.rate_hz = 90.0; // as near to 60 as to 120
    CHECK(bench.connect().sample_rate_hz == 120.0);
    bench.wish.both_eyes = false;
    bench.wish.eye = Eye::left;
    CHECK_FALSE(bench.connect().both_eyes);
    bench.driver.reset();
    CHECK(bench.library.ask("stand_in_held") == 0);
}

TEST_CASE("samples of both versions' data keep their times, their values and their order", "[unit]") {
    const std::string file = GENERATE(std::string(OVERT_STAND_IN_TOBII), std::string(OVERT_STAND_IN_TOBII_1));
    TobiiBench bench(file);
    bench.connect();
    bench.driver->start();
    REQUIRE(bench.read_samples(80) == RecordingState::running);
    bench.driver->stop();
    const auto samples = bench.items.all<GazeSample>();
    const ScreenGeometry& screen = bench.wish.screen;
    for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
        const GazeSample &left = samples[i], &right = samples[i + 1];
        CHECK(left.eye == Eye::left);
        CHECK(right.eye == Eye::right);
        CHECK(left.sampled_at == right.sampled_at);
        if (i > 0)
            CHECK((left.sampled_at - samples[i - 2].sampled_at).count() == 1666);
        // Of every tenth measurement the left eye is missing.
        const bool has_left = i / 2 % 10 != 9;
        CHECK(left.gaze.has_value() == has_left);
        CHECK(left.pupil_area == (has_left ? 3.0f : 0.0f));
        if (has_left)
            CHECK(*left.gaze == ScreenPoint{0.25 * screen.screen_px.x, 0.75 * screen.screen_px.y});
        CHECK(right.gaze == ScreenPoint{0.5 * screen.screen_px.x, 0.5 * screen.screen_px.y});
        CHECK(right.pupil_area == 4.0f);
    }
    const auto details = bench.items.all<SampleDetail>();
    REQUIRE(details.size() >= 2);
    CHECK(details[0].eye_mm == glm::vec3(-30.0f, 2.0f, 600.0f));
    CHECK(details[0].sampled_at == samples[0].sampled_at);
    CHECK(details[1].eye_mm == glm::vec3(30.0f, 2.0f, 600.0f));
    CHECK(bench.items.all<TrackerGap>().empty());
    // The port stood at 4 when it began, and changed once.
    const auto inputs = bench.items.all<TrackerInput>();
    REQUIRE(inputs.size() == 1);
    CHECK(inputs.front().value == 5);
    CHECK((inputs.front().at - samples.front().sampled_at).count() == 6 * 1666);
}

TEST_CASE("of one eye, only that one's samples are told", "[unit]") {
    TobiiBench bench;
    bench.wish.both_eyes = false;
    bench.wish.eye = Eye::left;
    bench.connect();
    bench.driver->start();
    REQUIRE(bench.read_samples(20) == RecordingState::running);
    for (const GazeSample& sample : bench.items.all<GazeSample>())
        CHECK(sample.eye == Eye::left);
    for (const SampleDetail& detail : bench.items.all<SampleDetail>())
        CHECK(detail.eye == Eye::left);
}

TEST_CASE("missing, dropped and turned back measurements of Tobii's are gaps", "[unit]") {
    TobiiBench bench;
    bench.library.set("missing_from", 20);
    bench.library.set("dropped_at", 30);
    bench.library.set("back_at", 35);
    bench.connect();
    bench.driver->start();
    REQUIRE(bench.read_samples(100) == RecordingState::running);
    const auto gaps = bench.items.all<TrackerGap>();
    const auto samples = bench.items.all<GazeSample>();
    REQUIRE(gaps.size() == 4);
    CHECK(gaps[0].reason == TrackerGap::Reason::connection);
    CHECK(gaps[0].lost_samples == 3);
    CHECK((gaps[0].after - samples.front().sampled_at).count() == 19 * 1666);
    CHECK(gaps[1].reason == TrackerGap::Reason::overflow);
    CHECK(gaps[1].lost_samples == 0);
    CHECK(gaps[2].reason == TrackerGap::Reason::unreadable);
    CHECK(gaps[2].lost_samples == 0);
    CHECK(gaps[3].reason == TrackerGap::Reason::connection);
    CHECK(gaps[3].lost_samples == 1);
    for (std::size_t i = 2; i < samples.size(); i += 2)
        CHECK(samples[i].sampled_at > samples[i - 2].sampled_at);
}

TEST_CASE("what a tracker of Tobii's says while nobody reads is kept until it is too much", "[unit]") {
    TobiiBench bench;
    bench.connect();
    TobiiInbox inbox(2, 8);
    const std::shared_ptr<const TobiiLibrary> library = load_tobii(OVERT_STAND_IN_TOBII);
    REQUIRE(inbox.begin_gaze(*library, nullptr) == tobii_ok);
    const SessionTime give_up = bench.clock.now() + 60s;
    std::int64_t overflow = 0;
    while (overflow < 5 && bench.clock.now() < give_up)
        overflow += inbox.take_overflow();
    inbox.end_gaze(*library, nullptr);
    CHECK(overflow >= 5);
    int kept = 0;
    for (TobiiNews news; inbox.next(news);)
        ++kept;
    CHECK(kept == 8);
}

TEST_CASE("readings of a Tobii's clock hold the truth between them, each is given once", "[unit]") {
    TobiiBench bench;
    bench.connect();
    for (int i = 0; i < 2; ++i) {
        const auto pair = bench.driver->read_clocks();
        REQUIRE(pair);
        // The stand-in's clock is this machine's monotonic one, 7000 s ahead.
        const auto monotonic = std::chrono::steady_clock::now().time_since_epoch();
        const SessionTime now = bench.clock.now();
        const auto truth = now - (monotonic - (pair->other.time_since_epoch() - std::chrono::seconds(7000)));
        CHECK(pair->before <= truth + 1us);
        CHECK(truth <= pair->after + 1ms); // between the two readings just above
        CHECK(pair->after - pair->before >= 300us);
    }
    CHECK_FALSE(bench.driver->read_clocks());
    bench.driver->start();
    bench.read_samples(10);
    CHECK(bench.items.all<ClockPair>().empty());
}

TEST_CASE("while Tobii's library has not asked for the time, arrivals bound the clock", "[unit]") {
    TobiiBench bench;
    bench.library.set("syncs", 0);
    bench.connect();
    CHECK_FALSE(bench.driver->read_clocks());
    bench.driver->start();
    bench.read_samples(10);
    const auto pairs = bench.items.all<ClockPair>();
    REQUIRE(!pairs.empty());
    CHECK(pairs.front().other == bench.items.all<GazeSample>().front().sampled_at);
    CHECK(pairs.front().after - pairs.front().before == 50ms);
}

TEST_CASE("a tracker of Tobii's that is lost or silent is lost, with a gap, and can be reached again",
          "[unit]") {
    const std::string how = GENERATE(std::string("lost_at"), "stream_lost_at", "silent_from", "back_from");
    TobiiBench bench;
    bench.settings.silence = 200ms;
    bench.library.set(how.c_str(), 25);
    bench.connect();
    bench.driver->start();
    CHECK(bench.read_samples(1'000'000) == RecordingState::lost);
    CHECK(bench.items.all<TrackerGap>().back().reason == TrackerGap::Reason::connection);
    CHECK(bench.items.all<TrackerGap>().back().after == bench.items.all<GazeSample>().back().sampled_at);
    bench.driver->stop();
    bench.library.set(how.c_str(), 1e9);
    bench.items.items.clear();
    CHECK(bench.driver->connect(bench.wish).both_eyes);
    bench.driver->start();
    CHECK(bench.read_samples(60) == RecordingState::running);
    CHECK(bench.items.all<TrackerGap>().empty());
    // The port's place is told anew in each recording, and is no change.
    CHECK(bench.items.all<TrackerInput>().size() == 1);
}

TEST_CASE("what a tracker of Tobii's complains of is said in the end, once", "[unit]") {
    TobiiBench bench(GENERATE(std::string(OVERT_STAND_IN_TOBII), std::string(OVERT_STAND_IN_TOBII_1)));
    bench.library.set("fault_at", 3);
    bench.connect();
    for (int recording = 0; recording < 2; ++recording) {
        bench.driver->start();
        bench.items.items.clear();
        bench.read_samples(20);
        bench.driver->stop();
    }
    CHECK(bench.driver->finish("", {}) ==
          std::vector<std::string>{"the tracker tells of a fault: the camera is hot"});
    for (const char* stream : {"gaze", "time", "port", "errors", "notifications"})
        CHECK(bench.library.heard(std::string("unsubscribe ") + stream));
}

TEST_CASE("of several trackers of Tobii's one is named, by serial number or address", "[unit]") {
    TobiiBench bench;
    bench.library.set("devices", 2);
    CHECK_THROWS_WITH(bench.connect(),
                      Contains("Several") &&
                          Contains("Glass 9000 SER1 at tet-tcp://10.0.0.1, Glass 9000 SER2"));
    bench.settings.device = "SER2";
    CHECK(bench.connect().model == "Glass 9000 SER2, firmware 2.6, SDK 2.11.7");
    bench.settings.device = "tet-tcp://10.0.0.7";
    CHECK(bench.connect().model == "Glass 9000 SER3, firmware 2.6, SDK 2.11.7");
    bench.settings.device = "tet-tcp://10.0.0.8";
    CHECK_THROWS_WITH(bench.connect(), Contains("no eye tracker at tet-tcp://10.0.0.8") &&
                                           Contains("error 204: the connection failed"));
    bench.settings.device = "tet-tcp://nothing";
    CHECK_THROWS_WITH(bench.connect(), Contains("no eye tracker at tet-tcp://nothing"));
    bench.settings.device = "SER9";
    CHECK_THROWS_WITH(bench.connect(), Contains("No eye tracker of Tobii's SER9") && Contains("SER1 at"));
    bench.settings.device = "";
    bench.library.set("devices", 0);
    CHECK_THROWS_WITH(bench.connect(),
                      Contains("No eye tracker of Tobii's is found. Trackers that are: none"));
    bench.library.set("find_status", 2);
    CHECK_THROWS_WITH(bench.connect(), Contains("error 2: the library could not be initialized"));
    bench.driver.reset();
    CHECK(bench.library.ask("stand_in_held") == 0);
}

TEST_CASE("a tracker of Tobii's that does not do what is needed is refused with a remedy", "[unit]") {
    TobiiBench bench;
    SECTION("another screen") {
        bench.library.set("width_mm", 527.0);
        CHECK_THROWS_WITH(bench.connect(), Contains("527 x 393 mm") && Contains("698 x 393 mm") &&
                                               Contains("Eye Tracker Manager"));
    }
    SECTION("a screen that is measured a little differently") {
        bench.library.set("width_mm", 710.0);
        CHECK_NOTHROW(bench.connect());
    }
    SECTION("no display area") {
        bench.library.set("area_status", 14);
        CHECK_THROWS_WITH(bench.connect(), Contains("error 14: the tracker's display area is not set"));
    }
    SECTION("no gaze on a screen") {
        bench.library.set("capabilities", 1 << 4);
        CHECK_THROWS_WITH(bench.connect(), Contains("Glass 9000 SER1 does not measure gaze on a screen"));
    }
    SECTION("no licence") {
        bench.connect();
        bench.library.set("gaze_status", 201);
        CHECK_THROWS_WITH(bench.driver->start(), Contains("error 201: it needs a licence"));
    }
    SECTION("a rate that it does not take") {
        bench.wish.rate_hz = 60.0;
        bench.library.set("rate_status", 202);
        CHECK_THROWS_WITH(bench.connect(), Contains("rate of 60 Hz (error 202"));
    }
    SECTION("a rate that was changed meanwhile") {
        bench.connect();
        bench.library.set("hz", 120);
        CHECK_THROWS_WITH(bench.driver->start(), Contains("at 120 Hz and not at 600 Hz"));
    }
    SECTION("a subscription that fails leaves none behind") {
        bench.library.set("port_status", 218);
        CHECK_THROWS_WITH(bench.connect(), Contains("its input port (error 218"));
        CHECK(bench.library.heard("unsubscribe errors"));
    }
    SECTION("no port, no subscription") {
        bench.library.set("capabilities", 0b101001);
        bench.connect();
        CHECK_FALSE(bench.library.heard("subscribe port"));
    }
}

TEST_CASE("without Tobii's library, or with one that cannot be used, it is said what to do", "[unit]") {
    CHECK_THROWS_WITH(load_tobii("/nowhere/libtobii_research.so"),
                      Contains("/nowhere/libtobii_research.so: cannot open shared object") &&
                          Contains("OVERT_TOBII_LIBRARY"));
    CHECK_THROWS_WITH(load_tobii(OVERT_STAND_IN_TOBII_LACKING),
                      Contains("it lacks tobii_research_find_all_eyetrackers;"));
    CHECK_THROWS_WITH(load_tobii(OVERT_STAND_IN_TOBII_3),
                      Contains("is version 3.11 of the Tobii Pro SDK") && Contains("versions 1 and 2"));
}
