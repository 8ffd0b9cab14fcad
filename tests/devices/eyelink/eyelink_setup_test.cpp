// The set-up's dialogue, through both forms of the library's hooks.
#include "devices/eyelink/eyelink_setup.h"

#include <catch2/catch.hpp>

#include "devices/eyelink/eyelink_driver.h"
#include "experiment/base/error.h"
#include "tests/devices/eyelink/eyelink_bench.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

SetupKey letter(char32_t character) { return {SetupKey::Kind::character, character}; }
SetupKey key_of(SetupKey::Kind kind) { return {kind}; }

struct SetupBench {
    StandIn library;
    SteadyClock clock;
    DiarySetupScreen setup_screen{clock};
    EyelinkSettings settings;
    EyelinkDriver driver;

    explicit SetupBench(std::string file = OVERT_STAND_IN_EYELINK)
        : library(std::move(file)),
          driver((settings.library = library.path, settings.drift_patience = 300ms, settings), clock) {
        driver.connect({});
        library.tell("calibration", "VALIDATION HV9 R RIGHT GOOD ERROR 0.45 avg. 0.76 max OFFSET 0.02 deg.");
    }
};

} // namespace

TEST_CASE("an EyeLink is set up on the set-up screen: targets, camera, sounds, words and keys", "[unit]") {
    const bool is_old = GENERATE(false, true);
    SetupBench bench(is_old ? OVERT_STAND_IN_EYELINK_OLD : OVERT_STAND_IN_EYELINK);
    bench.setup_screen.keys = {key_of(SetupKey::Kind::enter), letter('a'), letter('c'),
                               key_of(SetupKey::Kind::escape)};
    const SetupOutcome outcome = bench.driver.set_up(bench.setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    CHECK(outcome.method == "tracker, 9 points");
    REQUIRE(outcome.validation);
    CHECK(outcome.validation->mean_error.value == 0.45);
    CHECK(bench.setup_screen.showed("target 960 540 of 0.6"));
    CHECK(bench.setup_screen.showed(is_old ? "target 100 50 of 0.6" : "target 100 50.5 of 0.6"));
    CHECK(bench.setup_screen.showed(fmt::format("beep {}", static_cast<int>(Beep::target_appears))));
    CHECK(bench.setup_screen.showed(fmt::format("beep {}", static_cast<int>(Beep::calibration_good))));
    CHECK(bench.setup_screen.showed("text no pupil in 50%s"));
    CHECK(bench.setup_screen.showed("camera 32x24 Left, threshold 80"));
    REQUIRE(bench.setup_screen.camera.rgba.size() == 4 * 32 * 24);
    const std::byte* pixel = bench.setup_screen.camera.rgba.data() + 4 * (32 * 5 + 3); // row 5, column 3
    CHECK(std::to_integer<int>(pixel[0]) == 3);
    CHECK(std::to_integer<int>(pixel[1]) == (is_old ? 6 : 5));
    CHECK(std::to_integer<int>(pixel[2]) == (is_old ? 7 : 0));
    CHECK(bench.library.heard("key 13 type 1 state 1 with 0"));
    CHECK(bench.library.heard("key 99 type 1 state 1 with 0"));
}

TEST_CASE("a set-up of an EyeLink that ends without a good calibration says so", "[unit][waits]") {
    SetupBench bench;
    SECTION("left at once") {
        bench.setup_screen.keys = {key_of(SetupKey::Kind::escape)};
        const SetupOutcome outcome = bench.driver.set_up(bench.setup_screen);
        CHECK(outcome.kind == SetupOutcome::Kind::failed);
        CHECK(outcome.message == "Set-up was left without a calibration.");
    }
    SECTION("poor") {
        bench.library.set("calibration", 1);
        bench.setup_screen.keys = {letter('c'), key_of(SetupKey::Kind::escape)};
        const SetupOutcome outcome = bench.driver.set_up(bench.setup_screen);
        CHECK(outcome.kind == SetupOutcome::Kind::done);
        CHECK_THAT(outcome.message, Catch::Contains("poor"));
    }
    SECTION("failed") {
        bench.library.set("calibration", -1);
        bench.setup_screen.keys = {letter('c'), key_of(SetupKey::Kind::escape)};
        CHECK(bench.driver.set_up(bench.setup_screen).kind == SetupOutcome::Kind::failed);
    }
    SECTION("given up in the middle of it") {
        bench.library.set("calibration", 27);
        bench.setup_screen.keys = {letter('c'), key_of(SetupKey::Kind::escape)};
        CHECK(bench.driver.set_up(bench.setup_screen).kind == SetupOutcome::Kind::cancelled);
    }
    SECTION("the display was closed") {
        bench.setup_screen.on_target = [&] { bench.setup_screen.cancelled = true; };
        bench.setup_screen.keys = {letter('c')};
        CHECK(bench.driver.set_up(bench.setup_screen).kind == SetupOutcome::Kind::cancelled);
    }
}

TEST_CASE("what goes wrong on the set-up screen ends the EyeLink's dialogue and is told after it", "[unit]") {
    SetupBench bench(GENERATE(std::string(OVERT_STAND_IN_EYELINK), std::string(OVERT_STAND_IN_EYELINK_OLD)));
    bench.setup_screen.on_target = [] { throw DeviceError("the display is gone"); };
    bench.setup_screen.keys = {letter('c')};
    CHECK_THROWS_WITH(bench.driver.set_up(bench.setup_screen), "the display is gone");
    // The next one works.
    bench.setup_screen.on_target = nullptr;
    bench.setup_screen.keys = {letter('c'), key_of(SetupKey::Kind::escape)};
    CHECK(bench.driver.set_up(bench.setup_screen).kind == SetupOutcome::Kind::done);
}

TEST_CASE("an EyeLink's library that asks for keys while it fetches the file gets none", "[unit]") {
    SetupBench bench(GENERATE(std::string(OVERT_STAND_IN_EYELINK), std::string(OVERT_STAND_IN_EYELINK_OLD)));
    const TemporaryFolder folder;
    bench.setup_screen.keys = {letter('c'), key_of(SetupKey::Kind::escape)};
    bench.driver.set_up(bench.setup_screen);
    bench.setup_screen.keys = {key_of(SetupKey::Kind::escape)}; // nobody may take it now
    const auto said = bench.driver.finish(folder.path().string(), {});
    REQUIRE(said.size() == 1);
    CHECK_THAT(said[0], Catch::Contains("100000 bytes"));
    CHECK(bench.setup_screen.keys.size() == 1);
}

TEST_CASE("an EyeLink whose link breaks in its set-up is lost, and nothing hangs", "[unit]") {
    SetupBench bench;
    bench.setup_screen.on_target = [&] { bench.library.set("broken", 1); };
    bench.setup_screen.keys = {letter('c')};
    CHECK_THROWS_WITH(bench.driver.set_up(bench.setup_screen), Catch::Contains("lost during its set-up"));
}

TEST_CASE("an EyeLink's check of drift is measured, or asks for set-up, or finds no eye in time", "[unit]") {
    SetupBench bench;
    bench.library.tell("calibration", "DRIFTCORRECT R RIGHT at 512,384  OFFSET 0.35 deg.  11.4,-4.5 pix.");
    const auto measured = bench.driver.drift_check({512.4, 383.6});
    REQUIRE(measured);
    CHECK(measured->kind == DriftOutcome::Kind::measured);
    CHECK(measured->error.value == 0.35);
    CHECK(bench.library.heard("drift 512 384 0 0"));
    bench.library.tell("calibration", "done");
    CHECK_FALSE(bench.driver.drift_check({512, 384})); // no number: samples are to tell
    bench.library.set("drift", 27);
    // Not by a set-up that nobody sees, which would end with the patience.
    CHECK(bench.driver.drift_check({512, 384})->kind == DriftOutcome::Kind::set_up_wanted);
    bench.library.set("drift", 0);
    bench.library.set("drift_waits", 1); // nobody accepts
    CHECK(bench.driver.drift_check({512, 384})->kind == DriftOutcome::Kind::no_eye);
}

TEST_CASE("keys of the operator are those that the EyeLink's host knows", "[unit]") {
    using Kind = SetupKey::Kind;
    CHECK(eyelink_key(letter('c')) == 'c');
    CHECK(eyelink_key(letter(U'é')) == 0);
    CHECK(eyelink_key(key_of(Kind::enter)) == 0x0D);
    CHECK(eyelink_key(key_of(Kind::escape)) == 0x1B);
    CHECK(eyelink_key(key_of(Kind::up)) == 0x4800);
    CHECK(eyelink_key(key_of(Kind::down)) == 0x5000);
    CHECK(eyelink_key(key_of(Kind::left)) == 0x4B00);
    CHECK(eyelink_key(key_of(Kind::right)) == 0x4D00);
    CHECK(eyelink_key(key_of(Kind::page_up)) == 0x4900);
    CHECK(eyelink_key(key_of(Kind::page_down)) == 0x5100);
    CHECK(eyelink_key({Kind::function, 1}) == 0x3B00);
    CHECK(eyelink_key({Kind::function, 10}) == 0x4400);
    CHECK(eyelink_key({Kind::function, 11}) == 0);
}

TEST_CASE("an EyeLink whose link breaks while somebody sets it up at its host is lost", "[unit]") {
    SetupBench bench;
    bench.library.set("operated", 1);
    CHECK(bench.driver.set_up(bench.setup_screen).kind == SetupOutcome::Kind::done);
    bench.setup_screen.on_target = [&] { bench.library.set("broken", 1); };
    CHECK_THROWS_WITH(bench.driver.set_up(bench.setup_screen),
                      "The connection to the EyeLink was lost during its set-up. Look at the network cable "
                      "and at the host.");
}
