#include "devices/simulated/operator_script.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

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

TEST_CASE("what answers is read: keys with how long they are held, words, the mouse", "[unit]") {
    using InputKind = ObserverInput::Kind;
    const auto inputs = [](const std::string& words) {
        return read_operator_key("response screen+1=" + words, 4).inputs;
    };
    const auto held = inputs("press 7 for 0.4");
    REQUIRE(held.size() == 3);
    CHECK(held[0].input.kind == InputKind::key_down);
    CHECK(held[0].input.key.view() == "7");
    CHECK(held[1].input.character == U'7');
    CHECK(held[2].input.kind == InputKind::key_up);
    CHECK(held[2].after == std::chrono::milliseconds(400));
    CHECK(inputs("press left shift").size() == 2); // it writes nothing
    const auto typed = inputs("type a ä\u05d0");
    REQUIRE(typed.size() == 4);
    CHECK(typed[2].input.character == U'ä');
    CHECK(typed[3].input.character == U'\u05d0');
    const auto clicked = inputs("click -120.5 30");
    REQUIRE(clicked.size() == 3);
    CHECK(clicked[1].input.kind == InputKind::pointer_down);
    CHECK(clicked[1].input.right_px == -120.5);
    CHECK(clicked[1].input.down_px == 30.0);
    CHECK(clicked[1].input.device.view() == "mouse");
    const auto dragged = inputs("drag 0 0 100 -50");
    CHECK(dragged.back().input.kind == InputKind::pointer_up);
    CHECK(dragged.back().input.right_px == 100.0);
    CHECK(dragged.back().input.down_px == -50.0);
    CHECK(inputs("wheel -2").front().input.steps == -2.0);
    for (const char* wrong : {"click 1", "click 1 x", "drag 1 2 3", "wheel", "type ", "type"})
        CHECK_THROWS_AS(inputs(wrong), InputError);
}

TEST_CASE("an observer's script answers at its own times, and leaves other keys what they are", "[unit]") {
    SimulatedSitting sitting(31);
    VirtualClock& clock = sitting.clock;
    SimulatedResponsePanel panel(clock, sitting.observer,
                                 {read_operator_key("response screen@2+0.5=press 7 for 0.3", 4),
                                  read_operator_key("response screen@2+0.6=press left", 4)});
    panel.entered(SessionPhase::response_screen, 1);
    const SessionTime since = clock.now();
    panel.await_answer(since, nullptr);
    std::vector<ObserverInput> told;
    for (int i = 0; i < 300; ++i) {
        clock.wait_until(clock.now() + std::chrono::milliseconds(4));
        CHECK_FALSE(panel.poll());
        while (const auto input = panel.next_input())
            told.push_back(*input);
    }
    // By their times, and not one script after the other: 7 down, its letter, left down and up, 7 up.
    REQUIRE(told.size() == 5);
    CHECK(told[0].at == since + std::chrono::milliseconds(500));
    CHECK(told[2].key.view() == "left");
    CHECK(told[2].at == since + std::chrono::milliseconds(600));
    CHECK(told[4].key.view() == "7");
    CHECK(told[4].kind == ObserverInput::Kind::key_up);
    CHECK(told[4].at == since + std::chrono::milliseconds(800));
    CHECK(panel.closing_warnings().empty());
}

TEST_CASE("a scripted key is pressed once, at its time in its phase, and its question is answered",
          "[unit]") {
    SimulatedSitting sitting(31);
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

TEST_CASE("each phase and each of the operator's keys is read by its name, and digits up to 9", "[unit]") {
    for (int i = 0; i < session_phase_count; ++i) {
        const auto phase = static_cast<SessionPhase>(i);
        CHECK(read_operator_key(std::string(name_of(phase)) + "+1=pause", 4).phase == phase);
    }
    using Key = ResponsePress::Key;
    for (const Key key :
         {Key::pause, Key::recalibrate, Key::drift_check, Key::repeat, Key::reject, Key::skip, Key::abort})
        CHECK(read_operator_key("rest+1=" + std::string(name_of(key)), 4).key == key);
    CHECK(read_operator_key("rest+1=skip,1", 9).answer == U'1');
    CHECK(read_operator_key("rest+1=skip,9", 9).answer == U'9');
    CHECK(read_operator_key("rest+1=skip,4", 4).answer == U'4');
    CHECK(read_operator_key("rest+1=skip,no", 4).answer == U'n');
    CHECK(read_operator_key("rest+1=abort,yes", 4).answer == U'y');
    for (const char* wrong : {"rest+1=skip,11", "rest+1=skip,1x", "rest+1=skip,x",
                              "rest+1=skip,:", "rest+1=skip,5", "rest@0+1=pause", "rest+1=next"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(read_operator_key(wrong, 4), InputError);
    }
}

TEST_CASE("scripted inputs come at the times that their words have", "[unit]") {
    using InputKind = ObserverInput::Kind;
    const auto inputs = [](const std::string& words) {
        return read_operator_key("response screen+1=" + words, 4).inputs;
    };
    const auto ms = [](const ScriptedInput& input) { return input.after / std::chrono::milliseconds(1); };
    const auto pressed = inputs("press a");
    CHECK(ms(pressed.front()) == 0);
    CHECK(ms(pressed.back()) == 80);
    const auto typed = inputs("type abc");
    REQUIRE(typed.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(ms(typed[i]) == 50 * static_cast<long>(i));
        CHECK(typed[i].input.kind == InputKind::text);
    }
    const auto dragged = inputs("drag 10 20 110 -30");
    REQUIRE(dragged.size() == 13);
    CHECK(dragged[0].input.kind == InputKind::pointer_moved);
    CHECK(dragged[0].input.right_px == 10.0);
    CHECK(dragged[0].input.down_px == 20.0);
    CHECK(dragged[1].input.kind == InputKind::pointer_down);
    for (std::size_t i = 1; i <= 10; ++i) {
        CHECK(ms(dragged[i + 1]) == 20 * static_cast<long>(i));
        CHECK(dragged[i + 1].input.kind == InputKind::pointer_moved);
        CHECK(dragged[i + 1].input.right_px == Approx(10.0 + 10.0 * static_cast<double>(i)));
        CHECK(dragged[i + 1].input.down_px == Approx(20.0 - 5.0 * static_cast<double>(i)));
    }
    CHECK(dragged.back().input.kind == InputKind::pointer_up);
    CHECK(ms(dragged.back()) == 200);
}

TEST_CASE("what is no operator's key is refused with all that there is", "[unit]") {
    const auto refused = [](const char* text) {
        std::string why;
        try {
            read_operator_key(text, 3);
        } catch (const InputError& error) {
            why = error.what();
        }
        return why;
    };
    std::string phases;
    for (int i = 0; i < session_phase_count; ++i)
        phases += std::string(i == 0 ? "" : ", ") + std::string(name_of(static_cast<SessionPhase>(i)));
    CHECK_THAT(refused("now=skip"),
               Catch::StartsWith("--simulate-operator now=skip: there is no + or no =; write ") &&
                   Catch::Contains("Phases: " + phases + ". Keys: pause, recalibrate, "));
    // Letters of two, three and four bytes are one each.
    for (const auto& [text, character] :
         {std::pair("\u00e4", U'\u00e4'), {"\u20ac", U'\u20ac'}, {"\U0001F441", U'\U0001F441'}}) {
        const auto typed = read_operator_key(std::string("response screen+1=type ") + text, 3);
        REQUIRE(typed.inputs.size() == 1);
        CHECK(typed.inputs[0].input.character == character);
        const auto pressed = read_operator_key(std::string("response screen+1=press ") + text, 3);
        REQUIRE(pressed.inputs.size() == 3);
        CHECK(pressed.inputs[1].input.character == character);
        CHECK(pressed.key == ResponsePress::Key::next);
    }
}

TEST_CASE("what is wrong with an operator's key is told in its own words", "[unit]") {
    const auto why = [](const std::string& text, int reasons = 3) -> std::string {
        try {
            read_operator_key(text, reasons);
        } catch (const InputError& error) {
            const std::string said = error.what(), head = "--simulate-operator " + text + ": ";
            CHECK(said.starts_with(head));
            return said.substr(head.size(), said.find("; write PHASE") - head.size());
        }
        return "";
    };
    CHECK(why("stimulus=skip") == "there is no + or no =");
    CHECK(why("stimulus+1") == "there is no + or no =");
    CHECK(why("stimulus=a+b") == "there is no + or no =");
    CHECK(why("stimulus@0+1=skip") == "trials count from 1");
    CHECK(why("stimulus@x+1=skip") == "trials count from 1");
    CHECK(why("stimulus@1+1=skip").empty());
    CHECK(why("nowhere+1=skip") == "there is no phase \"nowhere\"");
    for (const char* const seconds : {"x", "-1", "86400", "nan", ""})
        CHECK(why(std::string("stimulus+") + seconds + "=skip") == "the seconds are no number of seconds");
    for (const char* const seconds : {"0", "0.5", "86399.9"})
        CHECK(why(std::string("stimulus+") + seconds + "=skip").empty());
    CHECK(why("stimulus+1=jump") == "there is no key \"jump\"");
    CHECK(why("stimulus+1=jump,2") == "there is no key \"jump\"");
    CHECK(why("stimulus+1=skip,perhaps") == "\"perhaps\" is no answer");
    for (const char* const answer : {"0", "10", "", ":", "/"})
        CHECK(why(std::string("stimulus+1=skip,") + answer) ==
              std::string("\"") + answer + "\" is no answer");
    CHECK(why("stimulus+1=repeat,2") == "only skipping has reasons");
    CHECK(why("stimulus+1=repeat,yes").empty());
    CHECK(why("stimulus+1=skip,no").empty());
    CHECK(why("stimulus+1=skip,3").empty());
    CHECK(why("stimulus+1=skip,4") == "there is no reason 4: [operator] skip_reasons has 3");
    CHECK(why("stimulus+1=skip,9", 9).empty());
    CHECK(why("stimulus+1=skip,1", 0) == "there is no reason 1: [operator] skip_reasons has 0");
    CHECK(why("stimulus+1=press ") == "the key has no name");
    CHECK(why("stimulus+1=press") == "the key has no name");
    CHECK(why("stimulus+1=type ") == "nothing is typed");
    CHECK(why("stimulus+1=click 1") == "click is followed by 2 numbers");
    CHECK(why("stimulus+1=click 1 x") == "click is followed by 2 numbers");
    CHECK(why("stimulus+1=click 1  2").empty()); // a blank more is none less
    CHECK(why("stimulus+1=click 1 2 3") == "click is followed by 2 numbers");
    CHECK(why("stimulus+1=drag 1 2 3") == "drag is followed by 4 numbers");
    CHECK(why("stimulus+1=drag 1 2 3 4").empty());
    CHECK(why("stimulus+1=wheel 1 2") == "wheel is followed by 1 numbers");
    CHECK(why("stimulus+1=wheel -2").empty());
    // A key is held for as long as is said, or for its usual time.
    const auto held = [](const char* text) {
        return read_operator_key(text, 0).inputs.back().after / std::chrono::milliseconds(1);
    };
    CHECK(held("stimulus+1=press 7") == 80);
    CHECK(held("stimulus+1=press 7 for 0.5") == 500);
    CHECK(held("stimulus+1=press 7 for 0") == 0);
    CHECK(read_operator_key("stimulus+1=press 7 for 0.5", 0).pressed == "7");
    CHECK(read_operator_key("stimulus+1=press 7 for -1", 0).pressed == "7 for -1");
    CHECK(read_operator_key("stimulus+1=press 7 for ever", 0).pressed == "7 for ever");
}

namespace {

/// What a script does, a word each: when in ms, what, where, which button, character, key and device.
std::string told(const std::string& words) {
    std::string all;
    for (const ScriptedInput& one : read_operator_key("response screen+1=" + words, 4).inputs) {
        const ObserverInput& input = one.input;
        all += fmt::format("{}:{}", to_seconds(one.after) * 1e3, static_cast<int>(input.kind));
        if (input.device.view() == "mouse")
            all += fmt::format(",{},{},b{},s{}", input.right_px, input.down_px, input.button, input.steps);
        else
            all += fmt::format(",{}{}@{}", input.key.view(), static_cast<int>(input.character),
                               input.device.view() == "simulated observer" ? "o" : input.device.view());
        all += " ";
    }
    return all;
}

} // namespace

TEST_CASE("what answers is done at its places, by its buttons, letters and devices, input for input",
          "[unit]") {
    CHECK(told("click 10 -20") == "0:3,10,-20,b0,s0 0:4,10,-20,b1,s0 80:5,10,-20,b1,s0 ");
    CHECK(told("drag 10 -20 30 5") ==
          "0:3,10,-20,b0,s0 0:4,10,-20,b1,s0 20:3,12,-17.5,b0,s0 40:3,14,-15,b0,s0 60:3,16,-12.5,b0,s0 "
          "80:3,18,-10,b0,s0 100:3,20,-7.5,b0,s0 120:3,22,-5,b0,s0 140:3,24,-2.5,b0,s0 160:3,26,0,b0,s0 "
          "180:3,28,2.5,b0,s0 200:3,30,5,b0,s0 200:5,30,5,b1,s0 ");
    CHECK(told("wheel 3") == "0:6,0,0,b0,s3 ");
    CHECK(told("press 7") == "0:0,70@o 0:2,55@o 80:1,70@o ");
    CHECK(told("press space for 0") == "0:0,space0@o 0:2,32@o 0:1,space0@o ");
    CHECK(told("press left for ever") == "0:0,left for ever0@o 80:1,left for ever0@o ");
    CHECK(told("type a\u20ac\U0001f600") == "0:2,97@o 50:2,8364@o 100:2,128512@o ");
    CHECK(told("press 7 for 0.25 for 0.5") == "0:0,7 for 0.250@o 500:1,7 for 0.250@o ");
}
