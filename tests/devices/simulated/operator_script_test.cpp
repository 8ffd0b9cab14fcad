#include "devices/simulated/operator_script.h"

#include <catch2/catch.hpp>

#include "devices/simulated/simulated_response_panel.h"
#include "experiment/base/error.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("an operator's key is read with its phase, trial, time and answer", "[unit]") {
    const ScriptedOperatorKey all = read_operator_key("response screen@12+0.25=skip,3", 4);
    CHECK(all.phase == SessionPhase::response_screen);
    CHECK(all.trial == 11);
    CHECK(all.after_s == 0.25);
    CHECK(all.key == ResponsePress::Key::skip);
    CHECK(all.answer == U'3');
    const ScriptedOperatorKey least = read_operator_key("rest+0=pause", 4);
    CHECK_FALSE(least.trial);
    CHECK(least.answer == U'y');
    for (const char* wrong : {"", "=", "+=", "rest+1=", "rest+1=pause,", "rest+1=pause,0", "rest@x+1=pause",
                              "rest+-1=pause", "rest+nan=pause", "@1+1=pause"})
        CHECK_THROWS_AS(read_operator_key(wrong, 4), InputError);
    const ScriptedOperatorKey pressed = read_operator_key("response screen+1=press left shift", 4);
    CHECK(pressed.pressed == "left shift");
    CHECK(pressed.key != ResponsePress::Key::next);
    for (const char* const goes_on : {"7", "å", "space", "enter", ","}) {
        CAPTURE(goes_on);
        const ScriptedOperatorKey key = read_operator_key(std::string("rest+1=press ") + goes_on, 4);
        CHECK(key.pressed == goes_on);
        CHECK(key.key == ResponsePress::Key::next);
    }
    CHECK_THROWS_AS(read_operator_key("rest+1=press ", 4), InputError);
    // A digit that is no reason would be waited at for ever.
    CHECK_THROWS_AS(read_operator_key("rest+1=skip,5", 4), InputError);
    CHECK_THROWS_AS(read_operator_key("rest+1=abort,1", 4), InputError);
}

TEST_CASE("a scripted key is pressed once, at its time in its phase, and its question is answered",
          "[unit]") {
    Sitting sitting(31);
    VirtualClock& clock = sitting.clock;
    SimulatedResponsePanel panel(clock, sitting.observer, {read_operator_key("stimulus@2+0.5=skip,2", 4)});
    const auto operators = [&](double seconds) {
        std::vector<ResponsePress::Key> keys;
        const SessionTime until = clock.now() + from_seconds(seconds);
        while (clock.now() < until) {
            clock.wait_until(clock.now() + std::chrono::milliseconds(4));
            while (const auto press = panel.poll())
                if (is_operators(press->key))
                    keys.push_back(press->key);
        }
        return keys;
    };
    REQUIRE(panel.closing_warnings().size() == 1);
    CHECK_THAT(panel.closing_warnings().front(),
               Catch::StartsWith("--simulate-operator stimulus@2+0.5=skip,2:"));
    panel.entered(SessionPhase::stimulus, 0);
    CHECK(operators(2.0).empty());
    panel.entered(SessionPhase::stimulus, 1);
    CHECK(operators(0.45).empty());
    CHECK(operators(0.1) == std::vector{ResponsePress::Key::skip});
    CHECK(panel.closing_warnings().empty());
    panel.await_decision(false, clock.now());
    clock.wait_until(clock.now() + std::chrono::milliseconds(1001));
    const auto answer = panel.poll();
    REQUIRE(answer);
    CHECK(answer->key == ResponsePress::Key::character);
    CHECK(answer->character == U'2');
    panel.entered(SessionPhase::stimulus, 1);
    CHECK(operators(2.0).empty());
}
