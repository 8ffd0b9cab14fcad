#include "devices/tobii/tobii_calibration.h"

#include <cmath>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/tobii/tobii_bench.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

struct Calibrating : TobiiBench {
    Calibrating() : setup_screen(clock) { connect(); }
    SetupOutcome calibrate() { return driver->set_up(setup_screen); }
    std::vector<std::string> said() const {
        std::vector<std::string> calls;
        for (const std::string& each : library.said())
            if (!each.starts_with("subscribe"))
                calls.push_back(each);
        return calls;
    }
    DiarySetupScreen setup_screen;
};

} // namespace

TEST_CASE("a Tobii's calibration measures at each target, computes, and tells what it found", "[unit]") {
    Calibrating bench;
    const SetupOutcome outcome = bench.calibrate();
    CHECK(bench.said() == std::vector<std::string>{"enter", "collect 500 500", "collect 100 100",
                                                   "collect 900 900", "compute", "leave"});
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    CHECK(outcome.method == "tracker, 3 points");
    CHECK_THAT(outcome.message, Contains("6 of 6 measurements") && Contains("not of a validation"));
    REQUIRE(outcome.validation);
    REQUIRE(outcome.validation->targets.size() == 6);
    const ScreenGeometry& screen = bench.wish.screen;
    double sum = 0.0, most = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
        const ValidatedTarget& target = outcome.validation->targets[i];
        const bool is_left = i % 2 == 0;
        CHECK(target.eye == (is_left ? Eye::left : Eye::right));
        const ScreenPoint shown = bench.settings.calibration_points[i / 2];
        CHECK(target.target.x_px == Approx(shown.x_px).margin(1e-3));
        REQUIRE(target.gaze);
        // The stand-in's left eye looks 1 % of the screen's width to the left, the right one 2 % to the
        // right.
        const ScreenPoint mean{shown.x_px + (is_left ? -0.01 : 0.02) * screen.screen_px.x, shown.y_px};
        CHECK(target.gaze->x_px == Approx(mean.x_px).margin(1e-3));
        CHECK(target.gaze->y_px == Approx(mean.y_px).margin(1e-3));
        const double error = screen.angle_between(shown, mean).value;
        CHECK(target.error.value == Approx(error).margin(1e-5));
        // Its left eye's two samples lie 1 % of the height above and below their mean, the right one's on it.
        REQUIRE(target.sd);
        const double spread =
            screen.angle_between(mean, {mean.x_px, mean.y_px + 0.01 * screen.screen_px.y}).value;
        CHECK(target.sd->value == Approx(is_left ? spread : 0.0).epsilon(1e-2).margin(1e-5));
        sum += error;
        most = std::max(most, error);
    }
    CHECK(outcome.validation->mean_error.value == Approx(sum / 6.0).margin(1e-5));
    CHECK(outcome.validation->max_error.value == Approx(most).margin(1e-5));
    // Targets appear at twice their size and shrink.
    CHECK(bench.setup_screen.diary.front() == "target 960 540 of 1");
    CHECK(bench.setup_screen.showed("target 960 540 of 0.5"));
    CHECK(bench.library.ask("stand_in_held") == 0);
}

TEST_CASE("a target that a Tobii cannot measure at comes a second time", "[unit]") {
    Calibrating bench;
    SECTION("and is measured then") {
        bench.library.tell("cannot_measure_once_at", "100 100");
        CHECK_THAT(bench.calibrate().message, Contains("6 of 6"));
        CHECK(bench.said() == std::vector<std::string>{"enter", "collect 500 500", "collect 100 100",
                                                       "discard 100 100", "collect 100 100",
                                                       "collect 900 900", "compute", "leave"});
    }
    SECTION("and is left out if it fails again") {
        bench.library.tell("cannot_measure_at", "100 100");
        const SetupOutcome outcome = bench.calibrate();
        CHECK(outcome.kind == SetupOutcome::Kind::done);
        CHECK(outcome.method == "tracker, 2 points");
    }
}

TEST_CASE("a Tobii's calibration that fails, or of the other eye only, is said to have failed", "[unit]") {
    Calibrating bench;
    SECTION("of both eyes") {
        bench.library.set("calibration", 0);
        const SetupOutcome outcome = bench.calibrate();
        CHECK(outcome.kind == SetupOutcome::Kind::failed);
        CHECK_THAT(outcome.message, Contains("too little"));
        CHECK_FALSE(outcome.validation);
    }
    SECTION("of the eye that the analysis takes") {
        bench.library.set("calibration", 2); // left only; the right one is wished
        const SetupOutcome outcome = bench.calibrate();
        CHECK(outcome.kind == SetupOutcome::Kind::failed);
        CHECK_THAT(outcome.message, Contains("not the right one"));
    }
    SECTION("of the other eye") {
        bench.library.set("calibration", 3);
        const SetupOutcome outcome = bench.calibrate();
        CHECK(outcome.kind == SetupOutcome::Kind::done);
        CHECK(outcome.validation->targets.size() == 3);
        CHECK_THAT(outcome.message, Contains("the other eye could not be calibrated"));
    }
    SECTION("one eye is wished") {
        bench.wish.both_eyes = false;
        bench.wish.eye = Eye::left;
        bench.connect();
        const SetupOutcome outcome = bench.calibrate();
        REQUIRE(outcome.validation);
        for (const ValidatedTarget& target : outcome.validation->targets)
            CHECK(target.eye == Eye::left);
    }
    CHECK(bench.library.ask("stand_in_held") == 0);
}

TEST_CASE("escape, a closed display and a tracker that does not answer end a Tobii's calibration", "[unit]") {
    Calibrating bench;
    SECTION("escape") {
        bench.setup_screen.on_target = [&] {
            if (bench.setup_screen.diary.size() > 15)
                bench.setup_screen.keys.push_back({SetupKey::Kind::escape});
        };
        CHECK(bench.calibrate().kind == SetupOutcome::Kind::cancelled);
        CHECK(bench.said() == std::vector<std::string>{"enter", "collect 500 500", "leave"});
    }
    SECTION("escape while it measures, which is waited for") {
        bench.library.set("collect_ms", 200);
        int waits = 0;
        bench.setup_screen.on_wait = [&] {
            if (bench.setup_screen.diary.size() >= 11 &&
                ++waits == 3) // eleven steps of a target, and then it measures
                bench.setup_screen.keys.push_back({SetupKey::Kind::escape});
        };
        CHECK(bench.calibrate().kind == SetupOutcome::Kind::cancelled);
        CHECK(bench.said() == std::vector<std::string>{"enter", "collect 500 500", "leave"});
    }
    SECTION("closed") {
        bench.setup_screen.cancelled = true;
        CHECK(bench.calibrate().kind == SetupOutcome::Kind::cancelled);
        CHECK(bench.said() == std::vector<std::string>{"enter", "leave"});
    }
    SECTION("no answer") {
        bench.library.set("collect_ms", 300);
        bench.settings.calibration_patience = 30ms;
        bench.connect();
        CHECK_THROWS_WITH(bench.calibrate(), Contains("does not end what it was to do"));
        std::this_thread::sleep_for(400ms); // it is still being measured
    }
    SECTION("it does not begin") {
        bench.library.set("enter_status", 210);
        CHECK_THROWS_WITH(bench.calibrate(), Contains("error 210: a calibration is under way already"));
    }
    SECTION("it does not compute") {
        bench.library.set("compute_status", 201);
        CHECK_THROWS_WITH(bench.calibrate(), Contains("does not compute its calibration (error 201"));
        CHECK(bench.said().back() == "leave");
    }
}

TEST_CASE("a Tobii's target is large at first, shrinks to its size, and what comes of it is heard",
          "[unit]") {
    Calibrating bench;
    const auto beeps = [&] {
        std::string all;
        for (const std::string& each : bench.setup_screen.diary)
            if (each.starts_with("beep "))
                all += each.substr(5);
        return all;
    };
    const auto beep = [](Beep which) { return std::to_string(static_cast<int>(which)); };
    const std::string appears = beep(Beep::target_appears), good = beep(Beep::calibration_good),
                      bad = beep(Beep::calibration_bad);
    bench.calibrate();
    CHECK(beeps() == appears + appears + appears + good);
    std::vector<std::string> first;
    for (int step = 10; step >= 0; --step)
        first.push_back(
            fmt::format("target 960 540 of {}", (1.0 + 0.1 * step) * bench.settings.target.value));
    first.insert(first.begin() + 1, "beep " + appears);
    REQUIRE(bench.setup_screen.diary.size() > 12);
    for (std::size_t i = 0; i < 12; ++i) {
        if (i == 1) {
            CHECK(bench.setup_screen.diary[i] == first[i]);
            continue;
        }
        double told = 0.0, wanted = 0.0;
        REQUIRE(std::sscanf(bench.setup_screen.diary[i].c_str(), "target 960 540 of %lf", &told) == 1);
        REQUIRE(std::sscanf(first[i].c_str(), "target 960 540 of %lf", &wanted) == 1);
        CHECK(told == Approx(wanted));
    }
    bench.setup_screen.diary.clear();
    bench.library.tell("cannot_measure_once_at", "100 100");
    bench.calibrate();
    CHECK(beeps() == appears + appears + bad + appears + appears + good);
    bench.setup_screen.diary.clear();
    bench.library.set("calibration", 0);
    bench.calibrate();
    CHECK(beeps() == appears + appears + appears + bad);
    CHECK(bench.setup_screen.cleared >= 3); // nothing is left on it
}

TEST_CASE("a Tobii is asked to measure, or to measure anew, where the target stands", "[unit]") {
    Calibrating bench;
    bench.settings.calibration_points = {{1440.0, 270.0}};
    bench.connect();
    bench.library.tell("cannot_measure_once_at", "750 250");
    CHECK(bench.calibrate().kind == SetupOutcome::Kind::done);
    std::vector<std::string> said = bench.said();
    std::erase_if(said, [](const std::string& each) { return each.starts_with("unsubscribe"); });
    CHECK(said == std::vector<std::string>{"enter", "collect 750 250", "discard 750 250", "collect 750 250",
                                           "compute", "leave"});
}

TEST_CASE("of a Tobii's eyes the other one is spoken of where both are wished and it could not be calibrated",
          "[unit]") {
    for (const bool both : {true, false})
        for (const Eye eye : {Eye::left, Eye::right})
            for (const int calibrated : {1, 2, 3}) { // both, the left, the right one
                Calibrating bench;
                bench.wish.both_eyes = both;
                bench.wish.eye = eye;
                bench.connect();
                bench.library.set("calibration", calibrated);
                const SetupOutcome outcome = bench.calibrate();
                const bool is_own = calibrated == 1 || (calibrated == 2) == (eye == Eye::left);
                CAPTURE(both, static_cast<int>(eye), calibrated);
                CHECK(outcome.kind == (is_own ? SetupOutcome::Kind::done : SetupOutcome::Kind::failed));
                const bool tells_other =
                    outcome.message.find("; the other eye could not") != std::string::npos;
                CHECK(tells_other == (is_own && both && calibrated != 1));
            }
}
