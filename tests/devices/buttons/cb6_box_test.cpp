#include "devices/buttons/cb6_box.h"

#include <catch2/catch.hpp>

#include "tests/devices/display_box/box_bench.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("buttons of a CB6 come through the status stream, timed by the box's clock", "[unit]") {
    Bench bench;
    bench.box.clock_zero = SessionTime(-5s);
    bench.box.drift_ppm = 60.0;
    DisplayPlusPlus display = bench.open();
    {
        Cb6Box box(display, bench.clock);
        CHECK(box.description().has_clock);
        CHECK(box.description().name == "cb6");
        REQUIRE(display.identity().product != display.identity().serial_number);
        CHECK(box.description().model == display.identity().product + " " + display.identity().serial_number);
        CHECK(box.button_name(2) == "B");
        CHECK(box.button_name(7) == "Din0");
        box.begin();
        std::array<ButtonChange, 8> changes;
        const auto after = [&](SessionDuration time) {
            bench.clock.wait_until(bench.clock.now() + time);
            return box.poll(changes);
        };
        CHECK(after(50ms) == 0);
        // B of the CB6 and the first digital input at once; 0 is pressed.
        const SessionTime pressed = bench.clock.now();
        bench.box.model.inputs = "0111111111101111";
        CHECK(box.poll(changes) == 0);
        REQUIRE(after(10ms) == 2);
        std::ranges::sort(std::span(changes).first(2), {}, &ButtonChange::button);
        CHECK(changes[0].button == 2);
        CHECK(changes[1].button == 7);
        for (int i = 0; i < 2; ++i) {
            const ButtonChange& change = changes[static_cast<std::size_t>(i)];
            CHECK(change.is_down);
            CHECK(change.at - change.uncertainty <= pressed + 1ms); // a sample's period later at most
            CHECK(change.at + change.uncertainty >= pressed);
            CHECK(change.uncertainty < 5ms);
        }
        bench.box.model.inputs = "1111111111111111";
        CHECK(after(10ms) == 2);
        CHECK_FALSE(changes[0].is_down);
        CHECK(bench.box.model.streaming);
        // What is down when a trial begins is no press.
        bench.box.model.inputs = "1111111111011111";
        box.begin();
        CHECK(after(10ms) == 0);
        bench.box.far.unplugged = true;
        CHECK(after(10ms) == 0);
        CHECK(box.lost());
    }
}

TEST_CASE("a CB6's stream ends with the box", "[unit]") {
    Bench bench;
    DisplayPlusPlus display = bench.open();
    { Cb6Box box(display, bench.clock); }
    CHECK_FALSE(bench.box.model.streaming);
}

TEST_CASE(
    "a CB6's buttons are letters and its digital inputs are counted from 0, and few are given at a time",
    "[unit]") {
    Bench bench;
    DisplayPlusPlus display = bench.open();
    Cb6Box box(display, bench.clock);
    const char* const names[] = {"A", "B", "C", "D", "E", "F", "Din0", "Din1", "Din2"};
    for (int button = 1; button <= 9; ++button)
        CHECK(box.button_name(button) == names[button - 1]);
    box.begin();
    std::array<ButtonChange, 8> changes;
    const auto after = [&](std::size_t room) {
        bench.clock.wait_until(bench.clock.now() + 20ms);
        return box.poll(std::span(changes).first(room));
    };
    CHECK(after(8) == 0);
    // A, C and F of the CB6 and the third digital input.
    bench.box.model.inputs = "1111111011"
                             "011010";
    std::string all;
    for (int i = 0; i < 4; ++i)
        for (std::size_t n = after(1), k = 0; k < n; ++k)
            all += box.button_name(changes[k].button) + (changes[k].is_down ? "+ " : "- ");
    CHECK(after(1) == 0);
    CHECK(std::ranges::count(all, '+') == 4);
    // What was held back before a trial is not told in it.
    bench.box.model.inputs = "1111111111111111";
    CHECK(after(1) == 1);
    box.begin();
    CHECK(after(8) == 0);
}
