#include "devices/opengaze/opengaze_tracker.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"
#include "experiment/protocol/protocol.h"
#include "tests/devices/opengaze/opengaze_bench.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

TEST_CASE("an Open Gaze tracker says who it is and how fast it really samples", "[unit]") {
    OpenGazeBench bench;
    const TrackerDescription description = bench.connect();
    CHECK(description.name == "Open Gaze");
    CHECK(description.model ==
          "GAZEPOINT GP3HD serial number 123456789 API 2.8 tracking a screen of 1920 x 1080 px");
    CHECK(description.sample_rate_hz == 150.0);
    CHECK(description.both_eyes);
    bench.model.rate_hz = 60.2; // while it says 150
    CHECK(bench.connect().sample_rate_hz == Approx(60.2).epsilon(1e-3));
    CHECK(bench.connect().told_rate_hz == 150.0);
    bench.model.told_rate = "fast";
    CHECK(bench.connect().sample_rate_hz == Approx(60.2).epsilon(1e-3));
}

TEST_CASE("records of Open Gaze become samples of both eyes in px of the screen, left first", "[unit]") {
    OpenGazeBench bench;
    bench.model.gaze = [](double) { return glm::dvec2(0.25, 0.75); };
    bench.model.left_is_valid = [](double time_s) { return std::fmod(time_s, 0.5) < 0.25; };
    bench.connect();
    REQUIRE(bench.record(2s) == RecordingState::running);
    const auto samples = bench.items.all<GazeSample>();
    REQUIRE(samples.size() >= 2 * 295);
    REQUIRE(samples.size() % 2 == 0);
    int lost = 0;
    for (std::size_t i = 0; i < samples.size(); i += 2) {
        const GazeSample &left = samples[i], &right = samples[i + 1];
        REQUIRE(left.eye == Eye::left);
        REQUIRE(right.eye == Eye::right);
        REQUIRE(left.sampled_at == right.sampled_at);
        lost += left.gaze ? 0 : 1;
        if (left.gaze) {
            CHECK(left.gaze->x_px == Approx(480.0));
            CHECK(left.gaze->y_px == Approx(810.0));
        }
        CHECK(left.pupil_area == (left.gaze ? 3.0f : 0.0f));
        REQUIRE(right.gaze);
        CHECK(right.gaze->x_px == Approx(672.0));
        CHECK(right.pupil_area == 4.0f);
        if (i > 0)
            REQUIRE((left.sampled_at - samples[i - 2].sampled_at).count() == Approx(6667).margin(1));
    }
    CHECK(lost == Approx(static_cast<double>(samples.size()) / 4.0).margin(4));
    const auto details = bench.items.all<SampleDetail>();
    REQUIRE_FALSE(details.empty());
    CHECK(*details.front().eye_mm == glm::vec3(-30.0f, 10.0f, 650.0f));
    CHECK(bench.items.all<TrackerGap>().empty());
}

TEST_CASE("of one eye, an Open Gaze tracker gives that eye's gaze or the best point", "[unit]") {
    OpenGazeBench bench;
    bench.wish.both_eyes = false;
    bench.wish.eye = Eye::left;
    const TrackerDescription description = bench.connect();
    CHECK_FALSE(description.both_eyes);
    CHECK(description.eye == Eye::left);
    bench.record(200ms);
    REQUIRE_FALSE(bench.items.all<GazeSample>().empty());
    for (const GazeSample& sample : bench.items.all<GazeSample>()) {
        CHECK(sample.eye == Eye::left);
        CHECK(sample.gaze->x_px == Approx(0.25 * 1920));
    }
    OpenGazeBench best;
    best.settings.point = TrackedPoint::best;
    CHECK_FALSE(best.connect().both_eyes);
    best.record(200ms);
    REQUIRE_FALSE(best.items.all<GazeSample>().empty());
    for (const GazeSample& sample : best.items.all<GazeSample>()) {
        CHECK(sample.eye == Eye::right);
        CHECK(sample.gaze->x_px == Approx(0.3 * 1920));
        CHECK(sample.pupil_area == 4.0f);
    }
}

TEST_CASE("records that an Open Gaze server left out or that cannot be read are gaps", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    bench.model.mutate = [first = 0](std::string record, int counter) mutable {
        first = first == 0 ? counter : first;
        if (counter - first >= 30 && counter - first < 34)
            return std::string();
        if (counter - first == 60)
            return record.substr(0, record.size() / 2) + "\r\n";
        return record;
    };
    bench.record(1s);
    const auto gaps = bench.items.all<TrackerGap>();
    REQUIRE(gaps.size() == 2);
    CHECK(gaps[0].reason == TrackerGap::Reason::overflow);
    CHECK(gaps[0].lost_samples == 4);
    CHECK(gaps[1].reason == TrackerGap::Reason::unreadable);
    CHECK(gaps[1].lost_samples == 1);
    const auto samples = bench.items.all<GazeSample>();
    CHECK(gaps[0].after == samples[2 * 29].sampled_at);
}

TEST_CASE("bounds of an Open Gaze tracker's clock hold the truth, and there are some in each second",
          "[unit]") {
    OpenGazeBench bench;
    const bool by_ticks = GENERATE(true, false);
    if (!by_ticks)
        bench.model.tick_frequency = "4704405731611246592";
    bench.connect();
    bench.record(5s);
    const auto pairs = bench.items.all<ClockPair>();
    REQUIRE(pairs.size() >= 5);
    const auto offset_us = static_cast<std::int64_t>((by_ticks ? 77.0 : 1000.0) * 1e6);
    for (const ClockPair& pair : pairs) {
        const SessionTime truth{std::chrono::microseconds(pair.other.time_since_epoch().count() - offset_us)};
        CHECK(pair.before <= truth);
        CHECK(truth <= pair.after + 10us); // the record's own last decimal
    }
}

TEST_CASE("a question to an Open Gaze server is repeated when no answer comes, and then given up", "[unit]") {
    OpenGazeBench bench;
    bench.model.silent_on = {"PRODUCT_ID", "ENABLE_SEND_COUNTER"};
    bench.model.silent_times = 1;
    CHECK(bench.connect().sample_rate_hz == 150.0);
    bench.model.silent_times = 1000;
    CHECK_THROWS_WITH(bench.connect(), Contains("in memory does not speak the Open Gaze API"));
    bench.model.silent_on = {"ENABLE_SEND_POG_LEFT"};
    const SessionTime begun = bench.clock.now();
    CHECK_THROWS_WITH(bench.connect(), Contains("does not answer to ENABLE_SEND_POG_LEFT"));
    CHECK(bench.clock.now() - begun < 12s);
    bench.model.silent_on.clear();
    bench.model.refused_on = {"ENABLE_SEND_POG_LEFT"};
    CHECK_THROWS_WITH(bench.connect(), Contains("refuses ENABLE_SEND_POG_LEFT"));
    bench.model.refused_on = {"ENABLE_SEND_PUPILMM", "ENABLE_SEND_USER_DATA", "TIME_TICK_FREQUENCY",
                              "SERIAL_ID"};
    CHECK(bench.connect().model == "GAZEPOINT GP3HD API 2.8 tracking a screen of 1920 x 1080 px");
    bench.model.has_camera = false;
    CHECK_THROWS_WITH(bench.connect(), Contains("sends no records") && Contains("finds its camera"));
    bench.far.unplugged = true;
    CHECK_THROWS_WITH(bench.connect(), Contains("is lost: unplugged by the test"));
}

TEST_CASE("an answer that comes too late is not taken for the next question's", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    OpenGazeLink link(std::make_unique<InMemoryLine>(bench.far), bench.clock, {});
    bench.far.delay = 4s; // so that the question is asked twice, and answered twice
    const auto product = link.get("PRODUCT_ID");
    bench.far.delay = 3500ms;
    const auto serial = link.get("SERIAL_ID");
    REQUIRE((product && serial));
    CHECK(product->message().value("VALUE") == "GP3HD");
    CHECK(serial->message().value("VALUE") == "123456789");
}

TEST_CASE("the stimulus screen is chosen where the setting says which", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    CHECK(bench.model.told("SCREEN_SIZE").empty());
    bench.settings.screen_origin_px = glm::ivec2(-1920, 0);
    bench.connect();
    CHECK_THAT(bench.model.told("SCREEN_SIZE"), Contains(R"(X="-1920" Y="0" WIDTH="1920" HEIGHT="1080")"));
}

TEST_CASE("a mark becomes user data of one record, and nothing in it can end the message", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    bench.tracker->start();
    bench.tracker->send({bench.clock.now(), "TRIALID 3 \"runner\" />"});
    bench.read_for(100ms);
    bench.tracker->stop();
    CHECK(bench.model.marks() == std::vector<std::string>{"TRIALID 3  runner  /"});
    CHECK_THAT(bench.model.told("USER_DATA"), Contains("DUR=\"1\""));
}

TEST_CASE("of marks that come between two records none is lost", "[unit]") {
    OpenGazeBench bench;
    bench.model.tells_user_data = GENERATE(true, false);
    bench.connect();
    bench.tracker->start();
    bench.read_for(50ms);
    bench.tracker->send({bench.clock.now(), "SYNCTIME"});
    bench.clock.wait_until(bench.clock.now() + 100us);
    bench.tracker->send({bench.clock.now(), "FRAME 0"});
    bench.read_for(50ms);
    bench.tracker->send({bench.clock.now(), "FRAME 1"});
    bench.read_for(50ms);
    bench.tracker->stop();
    CHECK(bench.model.borne == std::vector<std::string>{"SYNCTIME | FRAME 0", "FRAME 1"});
    CHECK(bench.tracker->finish("", {}).empty());
}

TEST_CASE("of too many marks for a record frames are left out first, and that is told", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_for(50ms);
    bench.tracker->send({bench.clock.now(), "TRIALID 3"});
    bench.tracker->send({bench.clock.now(), "!V TRIAL_VAR object " + std::string(60, 'o')});
    for (int i = 0; i < 30; ++i)
        bench.tracker->send({bench.clock.now(), fmt::format("FRAME {}", i)});
    bench.tracker->send({bench.clock.now(), "SYNCTIME " + std::string(180, 's')});
    bench.read_for(50ms);
    bench.tracker->stop();
    REQUIRE(bench.model.borne.size() == 1);
    CHECK(bench.model.borne.front() == "TRIALID 3 | SYNCTIME " + std::string(180, 's'));
    REQUIRE(bench.tracker->finish("", {}).size() == 1);
    CHECK_THAT(bench.tracker->finish("", {}).front(), Contains("30 of frames and 1 others"));
    bench.tracker->send({bench.clock.now(), std::string(1000, 'x')});
    CHECK(bench.model.marks().back().size() == OpenGazeMarks::longest);
}

TEST_CASE("an Open Gaze server that falls silent or goes away is lost, with a gap", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    bench.tracker->start();
    REQUIRE(bench.read_for(500ms) == RecordingState::running);
    SECTION("silent") {
        bench.model.has_camera = false;
        const SessionTime begun = bench.clock.now();
        CHECK(bench.read_for(10s) == RecordingState::lost);
        CHECK(bench.clock.now() - begun < 2100ms);
    }
    SECTION("gone") {
        bench.far.unplugged = true;
        CHECK(bench.read_for(10s) == RecordingState::lost);
    }
    const auto samples = bench.items.all<GazeSample>();
    REQUIRE_FALSE(bench.items.all<TrackerGap>().empty());
    CHECK(bench.items.all<TrackerGap>().back().reason == TrackerGap::Reason::connection);
    CHECK(bench.items.all<TrackerGap>().back().after == samples.back().sampled_at);
}

TEST_CASE("a protocol says where Gazepoint's server is, which point counts and where targets stand",
          "[unit]") {
    Protocol protocol;
    CHECK(describe(opengaze_settings_of(protocol).server) == "127.0.0.1:4242");
    protocol.tracker.address = "10.0.0.7:99";
    protocol.tracker.point = TrackedPoint::best;
    protocol.calibration.points = 5;
    const OpenGazeSettings settings = opengaze_settings_of(protocol);
    CHECK(describe(settings.server) == "10.0.0.7:99");
    CHECK(settings.point == TrackedPoint::best);
    REQUIRE(settings.calibration_points.size() == 5);
    const auto targets = calibration_targets(5, protocol.calibration.area, screen_geometry_of(protocol));
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(settings.calibration_points[i].x == Approx(targets[i].x_px / protocol.display.width_px));
        CHECK(settings.calibration_points[i].y == Approx(targets[i].y_px / protocol.display.height_px));
        CHECK(settings.calibration_points[i].x < 1.0);
    }
}

TEST_CASE("a rate needs three records with times, of thirty at most in three seconds", "[unit]") {
    for (const int records : {0, 1, 2, 3, 29, 30, 31}) {
        OpenGazeBench bench;
        int sent = 0;
        bench.model.mutate = [&](std::string record, int) {
            return ++sent <= records ? record : std::string();
        };
        const SessionTime began = bench.clock.now();
        CAPTURE(records);
        if (records < 3) {
            CHECK_THROWS_WITH(bench.connect(),
                              Contains(fmt::format("sends no records with times ({} came in 3 s)", records)));
        } else {
            CHECK(bench.connect().sample_rate_hz == 150.0);
        }
        // All three seconds are waited for where fewer than thirty come.
        CHECK((bench.clock.now() - began >= 3s) == (records < 30));
        CHECK(bench.clock.now() - began < 3500ms);
    }
    // Records without times are none.
    OpenGazeBench bench;
    bench.model.mutate = [](std::string record, int) {
        const std::size_t at = record.find(" TIME=");
        return record.replace(at, 6, " XIME=");
    };
    CHECK_THROWS_WITH(bench.connect(), Contains("(30 came in 3 s)"));
    // The median of the intervals, whatever one of them is.
    OpenGazeBench jumping;
    jumping.model.told_rate = "";
    jumping.model.mutate = [](std::string record, int counter) {
        return counter == 7 ? std::string() : record;
    };
    CHECK(jumping.connect().sample_rate_hz == Approx(150.0).epsilon(1e-3));
}

TEST_CASE("between connection and recording an Open Gaze server sends nothing, however long that is",
          "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    CHECK_THAT(bench.model.told("ENABLE_SEND_DATA"), Contains("STATE=\"0\""));
    bench.clock.wait_until(bench.clock.now() + 60s);
    // Silence is counted from the recording's beginning, until records come.
    bench.model.has_camera = false;
    bench.tracker->start();
    CHECK_THAT(bench.model.told("ENABLE_SEND_DATA"), Contains("STATE=\"1\""));
    const SessionTime began = bench.clock.now();
    CHECK(bench.read_for(bench.settings.timeouts.silence - 10ms) == RecordingState::running);
    CHECK(bench.read_for(1s) == RecordingState::lost);
    CHECK(bench.clock.now() - began < bench.settings.timeouts.silence + 10ms);
    bench.tracker->stop();
    CHECK_THAT(bench.model.told("ENABLE_SEND_DATA"), Contains("STATE=\"0\""));
    // A server that refuses to stop is not waited for.
    bench.model.has_camera = true;
    bench.tracker->start();
    CHECK(bench.read_for(100ms) == RecordingState::running);
    bench.model.refused_on = {"ENABLE_SEND_DATA"};
    const SessionTime stopped = bench.clock.now();
    bench.tracker->stop();
    CHECK(bench.clock.now() - stopped < 100ms);
    bench.model.refused_on.clear();
    bench.model.silent_on = {"ENABLE_SEND_DATA"};
    bench.model.has_camera = false;
    const SessionTime asked = bench.clock.now();
    bench.tracker->stop();
    CHECK(bench.clock.now() - asked >= 500ms);
}

TEST_CASE("messages that are left out of Gazepoint's user data are told, of frames or of others alone",
          "[unit]") {
    const auto said = [](const std::vector<std::string>& marks) {
        OpenGazeBench bench;
        bench.connect();
        bench.tracker->start();
        for (const std::string& mark : marks)
            bench.tracker->send({bench.clock.now(), mark});
        bench.tracker->stop();
        const std::vector<std::string> all = bench.tracker->finish("", {});
        return all.empty() ? std::string() : all.front();
    };
    CHECK(said({"TRIALID 1", "FRAME 1"}).empty());
    const std::string last(OpenGazeMarks::longest, 's');
    CHECK_THAT(said({"TRIALID 1", last}), Contains("0 of frames and 1 others"));
    CHECK_THAT(said({"TRIALID 1", "!V x", last}), Contains("0 of frames and 2 others"));
    CHECK_THAT(said({"FRAME 1", last}), Contains("1 of frames and 0 others"));
    CHECK_THAT(said({"FRAME 1", "TRIALID 1", last}), Contains("1 of frames and 1 others"));
}
