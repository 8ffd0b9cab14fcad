#include "devices/opengaze/opengaze_calibration.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/opengaze/opengaze_bench.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

TEST_CASE(
    "an Open Gaze server's calibration shows its targets on the set-up screen and gives each eye's errors",
    "[unit]") {
    OpenGazeBench bench;
    bench.settings.calibration_points = {{0.5, 0.5}, {0.1, 0.9}, {0.9, 0.1}};
    bench.model.invalid_points = {2}; // for the left eye
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    const SetupOutcome outcome = bench.tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    REQUIRE(setup_screen.targets.size() == 3);
    CHECK(setup_screen.targets[1].x_px == Approx(192.0));
    CHECK(setup_screen.targets[1].y_px == Approx(972.0));
    CHECK(setup_screen.beeps == 3);
    CHECK(outcome.method == "tracker, 3 points");
    CHECK_THAT(outcome.message,
               Contains("5 of 6 measurements") && Contains("not of a validation") && Contains("19.4 px"));
    REQUIRE(outcome.validation);
    REQUIRE(outcome.validation->targets.size() == 6);
    const ValidatedTarget& first = outcome.validation->targets[0];
    CHECK(first.eye == Eye::left);
    REQUIRE(first.gaze);
    CHECK(first.gaze->x_px == Approx(979.2));
    // By hand: 19.2 px of 698.4 mm / 1920 px are 6.984 mm beside the middle, at 1750 mm.
    CHECK(first.error.value == Approx(0.228658).epsilon(1e-4));
    CHECK_FALSE(outcome.validation->targets[2].gaze);
    CHECK(outcome.validation->mean_error.value > 0.2);
    CHECK(outcome.validation->max_error >= outcome.validation->mean_error);
    CHECK_THAT(bench.model.told("CALIBRATE_SHOW"), Contains("STATE=\"0\""));
    CHECK_THAT(bench.model.told("CALIBRATE_TIMEOUT"), Contains("VALUE=\"1.250\""));
}

TEST_CASE("without points of our own an Open Gaze server takes its own, and one eye's errors count",
          "[unit]") {
    OpenGazeBench bench;
    bench.wish.both_eyes = false;
    bench.wish.eye = Eye::right;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    const SetupOutcome outcome = bench.tracker->set_up(setup_screen);
    CHECK(setup_screen.targets.size() == 5);
    REQUIRE(outcome.validation);
    CHECK(outcome.validation->targets.size() == 5);
    for (const ValidatedTarget& target : outcome.validation->targets)
        CHECK(target.eye == Eye::right);
}

TEST_CASE("an Open Gaze calibration that finds no eye has failed", "[unit]") {
    OpenGazeBench bench;
    bench.wish.both_eyes = false;
    bench.wish.eye = Eye::left;
    bench.model.invalid_points = {1, 2, 3, 4, 5};
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    const SetupOutcome outcome = bench.tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::failed);
    CHECK_FALSE(outcome.validation);
    CHECK_THAT(outcome.message, Contains("at none of its targets"));
}

TEST_CASE("an Open Gaze calibration ends when the operator escapes or the display is closed", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    SECTION("escape") {
        setup_screen.keys_after = 2;
        setup_screen.keys = {SetupKey{SetupKey::Kind::escape}};
    }
    SECTION("closed") { setup_screen.cancel_after = 2; }
    CHECK(bench.tracker->set_up(setup_screen).kind == SetupOutcome::Kind::cancelled);
    CHECK(setup_screen.targets.size() == 2);
    CHECK_THAT(bench.model.told("CALIBRATE_START"), Contains("STATE=\"0\""));
}

TEST_CASE("an Open Gaze calibration that never ends, or that the server does not begin, is told", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    bench.model.points.assign(400, {0.5, 0.5}); // 80 s, while the server tells of 5
    bench.model.refused_on = {"CALIBRATE_ADDPOINT"};
    const SessionTime begun = bench.clock.now();
    const SetupOutcome outcome = bench.tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::failed);
    CHECK_THAT(outcome.message, Contains("did not end"));
    CHECK(bench.clock.now() - begun < 60s);
    bench.model.refused_on = {"CALIBRATE_START"};
    CHECK_THROWS_WITH(bench.tracker->set_up(setup_screen), Contains("does not begin to calibrate"));
    bench.model.refused_on.clear();
    bench.far.unplugged = true;
    CHECK_THROWS_AS(bench.tracker->set_up(setup_screen), DeviceError);
}

TEST_CASE("the tracker's own window can show the targets instead", "[unit]") {
    OpenGazeBench bench;
    bench.settings.own_calibration_screen = true;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    CHECK(bench.tracker->set_up(setup_screen).kind == SetupOutcome::Kind::done);
    CHECK(setup_screen.targets.empty());
    REQUIRE_FALSE(setup_screen.texts.empty());
    CHECK_THAT(setup_screen.texts.front(), Contains("own window"));
}

TEST_CASE("the tracker's clock goes on over a calibration, after which its seconds begin anew", "[unit]") {
    OpenGazeBench bench;
    bench.model.tick_frequency = "0";
    bench.connect();
    bench.record(300ms);
    const TrackerTime before = bench.items.all<GazeSample>().back().sampled_at;
    ScriptedSetupScreen setup_screen(bench.clock);
    bench.tracker->set_up(setup_screen);
    bench.items.items.clear();
    bench.record(300ms);
    CHECK(bench.items.all<GazeSample>().front().sampled_at > before);
    CHECK(bench.items.all<GazeSample>().front().sampled_at < before + 5s);
}

TEST_CASE("of a calibration's result twenty-five points are read, of the eyes that are wished", "[unit]") {
    std::string attributes = " ID=\"CALIB_RESULT\"";
    for (int i = 1; i <= 26; ++i)
        attributes += fmt::format(
            " CALX{0}=\"0.5\" CALY{0}=\"0.5\" LX{0}=\"0.5\" LY{0}=\"0.5\" LV{0}=\"1\" RX{0}=\"0.5\" "
            "RY{0}=\"0.5\" RV{0}=\"{1}\"",
            i, i % 2);
    OpenGazeMessage message;
    message.kind = OpenGazeMessage::Kind::calibration;
    message.attributes = attributes;
    OpenGazeSettings settings;
    TrackerWish wish;
    wish.both_eyes = true;
    const SetupOutcome both = outcome_of(message, settings, wish);
    CHECK(both.method == "tracker, 25 points");
    CHECK(both.validation.value().targets.size() == 50);
    CHECK_THAT(both.message, Catch::StartsWith("38 of 50 measurements"));
    wish.both_eyes = false;
    wish.eye = Eye::left;
    CHECK_THAT(outcome_of(message, settings, wish).message, Catch::StartsWith("25 of 25 measurements"));
    wish.eye = Eye::right;
    CHECK_THAT(outcome_of(message, settings, wish).message, Catch::StartsWith("13 of 25 measurements"));
    settings.point = TrackedPoint::best;
    CHECK(outcome_of(message, settings, wish).validation.value().targets.size() == 50);
    message.attributes = " ID=\"CALIB_RESULT\"";
    CHECK(outcome_of(message, settings, wish).kind == SetupOutcome::Kind::failed);
    CHECK(outcome_of(message, settings, wish).message ==
          "the tracker ended its calibration without a result");
}

TEST_CASE("what a calibration says while answers are waited for is kept, four hundred messages of it",
          "[unit]") {
    VirtualClock clock;
    FarEnd far(clock);
    far.answer = [](std::string_view) {
        std::string all = "<REC CNT=\"1\" />\r\n";
        for (int i = 0; i < 405; ++i)
            all += fmt::format("<CAL ID=\"CALIB_START_PT\" PT=\"{}\" />\r\n", i);
        return all + "<ACK ID=\"OTHER\" />\r\n<ACK ID=\"PRODUCT_ID\" VALUE=\"it\" />\r\n";
    };
    OpenGazeLink link(std::make_unique<InMemoryLine>(far), clock, {});
    const auto answer = link.get("PRODUCT_ID");
    REQUIRE(answer);
    CHECK(answer->message().value("VALUE") == "it");
    int count = 0;
    while (const auto said = link.next_calibration_message(clock.now()))
        CHECK(said->message().number("PT") == count++);
    CHECK(count == 400);
    far.answer = [](std::string_view) { return std::string("<CAL ID=\"x\" />\r\n<NACK ID=\"Y\" />\r\n"); };
    CHECK_FALSE(link.set("Y", "STATE=\"1\"")->is_granted);
    CHECK(link.send_set("Y", "", clock.now() + std::chrono::milliseconds(1)));
    far.takes_bytes = false;
    CHECK_FALSE(link.send_set("Y", "", clock.now() + std::chrono::milliseconds(1)));
    far.takes_bytes = true;
    link.forget();
    CHECK_FALSE(link.next_calibration_message(clock.now()));
}

TEST_CASE("an Open Gaze calibration has ten seconds, and for each of up to 25 targets its time and two more",
          "[unit]") {
    const auto waited_s = [](auto change) {
        OpenGazeBench bench;
        bench.model.calibration_hangs = true;
        bench.settings.target_delay = 500ms;
        bench.settings.target_time = 1500ms;
        bench.settings.timeouts.reply = 100ms;
        change(bench);
        bench.connect();
        ScriptedSetupScreen setup_screen(bench.clock);
        const SessionTime begun = bench.clock.now();
        CHECK(bench.tracker->set_up(setup_screen).message ==
              "the tracker did not end its calibration in time");
        CHECK_THAT(bench.model.told("CALIBRATE_START"), Contains("STATE=\"0\""));
        return to_seconds(bench.clock.now() - begun);
    };
    const auto for_points = [](int points) { return Approx(10.0 + 4.0 * points).margin(0.6); };
    CHECK(waited_s([](OpenGazeBench&) {}) == for_points(5));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.told_points = "7"; }) == for_points(7));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.told_points = "0"; }) == for_points(1));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.told_points = "25"; }) == for_points(25));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.told_points = "26"; }) == for_points(25));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.told_points = "many"; }) == for_points(9));
    CHECK(waited_s([](OpenGazeBench& bench) { bench.model.silent_on = {"CALIBRATE_ADDPOINT"}; }) ==
          for_points(9));
    CHECK(waited_s([](OpenGazeBench& bench) {
              bench.settings.calibration_points.assign(3, {0.5, 0.5});
          }) == for_points(3));
}

TEST_CASE("points of our own that an Open Gaze server does not take are refused with which was", "[unit]") {
    for (const char* const id : {"CALIBRATE_CLEAR", "CALIBRATE_ADDPOINT"})
        for (const bool is_silent : {true, false}) {
            OpenGazeBench bench;
            bench.settings.calibration_points = {{0.25, 0.75}};
            bench.settings.timeouts.reply = 100ms;
            bench.connect();
            (is_silent ? bench.model.silent_on : bench.model.refused_on) = {id};
            ScriptedSetupScreen setup_screen(bench.clock);
            CHECK_THROWS_WITH(bench.tracker->set_up(setup_screen),
                              Contains(std::string("(") + id + "); leave calibration_points out"));
        }
    OpenGazeBench bench;
    bench.settings.calibration_points = {{0.25, 0.75}};
    bench.settings.target_delay = 250ms;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    bench.tracker->set_up(setup_screen);
    CHECK_THAT(bench.model.told("CALIBRATE_ADDPOINT"), Contains("X=\"0.25000\" Y=\"0.75000\""));
    CHECK_THAT(bench.model.told("CALIBRATE_DELAY"), Contains("VALUE=\"0.250\""));
    // It does not answer to what sums it up, or refuses it.
    bench.settings.timeouts.reply = 100ms;
    bench.model.refused_on = {"CALIBRATE_RESULT_SUMMARY"};
    CHECK_THAT(bench.tracker->set_up(setup_screen).message, !Contains("mean error"));
}

TEST_CASE("the first answer of its id is a question's, whatever comes beside it", "[unit]") {
    VirtualClock clock;
    FarEnd far(clock);
    far.answer = [](std::string_view) {
        return std::string("<ACK ID=\"A\" VALUE=\"no\" />\r\n<REC ID=\"Q\" VALUE=\"no\" />\r\n<CAL ID=\"Q\" "
                           "VALUE=\"no\" />\r\n<ACK ID=\"Q\" VALUE=\"1\" />\r\n<NACK ID=\"Q\" VALUE=\"2\" "
                           "/>\r\n<ACK ID=\"Z\" VALUE=\"no\" />\r\n");
    };
    OpenGazeLink link(std::make_unique<InMemoryLine>(far), clock, {});
    const auto answer = link.get("Q");
    REQUIRE(answer);
    CHECK(answer->is_granted);
    CHECK(answer->message().value("VALUE") == "1");
}

TEST_CASE("what an Open Gaze server said of an earlier calibration is not taken for this one's", "[unit]") {
    OpenGazeBench bench;
    bench.connect();
    bench.tracker->start();
    bench.far.send(bench.clock.now(), "<CAL ID=\"CALIB_RESULT\" />\r\n");
    bench.read_for(20ms);
    bench.far.send(bench.clock.now(), "<CAL ID=\"CALIB_RESULT\" />\r\n");
    ScriptedSetupScreen setup_screen(bench.clock);
    const SessionTime began = bench.clock.now();
    const SetupOutcome outcome = bench.tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    CHECK(setup_screen.targets.size() == 5);
    CHECK(bench.clock.now() - began >= 1s);
}
