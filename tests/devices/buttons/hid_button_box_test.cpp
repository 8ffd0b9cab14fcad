#include "devices/buttons/hid_button_box.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// What a report changes, such as "+3 -1".
std::string changes_of(HidButtons& buttons, std::initializer_list<int> report) {
    std::string changes;
    buttons.take(bytes_of(report), [&](int number, bool is_down) {
        changes +=
            fmt::format("{}{}{}", changes.empty() ? "" : " ", is_down ? "+" : "-", hid_button_name(number));
    });
    return changes;
}

} // namespace

TEST_CASE("buttons of a game pad are told when they change, whatever its axes do", "[unit]") {
    HidButtons pad(parse_report_descriptor(game_pad_descriptor()));
    CHECK(changes_of(pad, {128, 128, 0, 0}).empty());
    CHECK(changes_of(pad, {0, 255, 0b0000'0101, 0b10}) == "+1 +3 +10");
    CHECK(changes_of(pad, {0, 255, 0b0000'0101, 0b10}).empty());
    CHECK(changes_of(pad, {0, 255, 0b0000'0110, 0xFC}) == "-1 +2 -10"); // the rest fills up the byte
    CHECK(changes_of(pad, {0, 255, 0}).empty());                        // cut off
}

TEST_CASE("keys of a keyboard are told when they change, and not when too many are down", "[unit]") {
    HidButtons keys(parse_report_descriptor(keyboard_descriptor()));
    CHECK(changes_of(keys, {0, 0, 0x1E, 0, 0, 0, 0, 0}) == "+1");
    CHECK(changes_of(keys, {0x02, 0, 0x2C, 0x1E, 0, 0, 0, 0}) ==
          "+space +key 225"); // left shift, in another place
    CHECK(changes_of(keys, {0x02, 0, 1, 1, 1, 1, 1, 1}).empty());
    CHECK(changes_of(keys, {0, 0, 0x2C, 0, 0, 0, 0, 0}) == "-1 -key 225");
    CHECK(changes_of(keys, {0, 0, 0, 0, 0, 0, 0, 200}) == "-space"); // 200 is outside of its range
    CHECK(changes_of(keys, {0, 0, 2, 3, 0, 0, 0, 0}).empty());       // errors of the keyboard
    CHECK(changes_of(keys, {0, 0, 4, 3, 0, 0, 0, 0}) == "+a");
    CHECK(hid_button_name(first_key_number + 0x04) == "a");
    CHECK(hid_button_name(first_key_number + 0x27) == "0");
    CHECK(hid_button_name(5) == "5");
}

TEST_CASE("presses of a HID box are timed by when they were fetched", "[unit]") {
    VirtualClock clock(SessionTime(1s));
    HidFarEnd far(clock);
    const HidDescriptor descriptor = parse_report_descriptor(game_pad_descriptor());
    far.arriving.push_back({SessionTime(1s), bytes_of({0, 0, 1, 0})}); // down before the trial
    HidButtonBox box(std::make_unique<InMemoryHidLine>(far), descriptor, "pad", clock);
    CHECK_FALSE(box.description().has_clock);
    std::array<ButtonChange, 2> changes;
    CHECK(box.poll(changes) == 0);
    const SessionTime looked = clock.now();
    far.arriving.push_back({looked + 3ms, bytes_of({0, 0, 0b1110, 0})});
    clock.wait_until(looked + 8ms);
    REQUIRE(box.poll(changes) == 2); // button 1 up, 2 down, and no room for more
    CHECK(changes[0].button == 1);
    CHECK_FALSE(changes[0].is_down);
    CHECK(changes[1].button == 2);
    CHECK_FALSE(changes[1].device_time);
    CHECK(changes[1].at - changes[1].uncertainty <= looked);
    CHECK(changes[1].at + changes[1].uncertainty >= looked + 8ms);
    REQUIRE(box.poll(changes) == 2);
    CHECK(changes[1].button == 4);
    CHECK(box.poll(changes) == 0);
    far.unplugged = true;
    CHECK(box.poll(changes) == 0);
    CHECK(box.lost());
    CHECK_THROWS_AS(box.begin(), DeviceError);
}

TEST_CASE("a HID device without buttons is no response box", "[unit]") {
    VirtualClock clock;
    HidFarEnd far(clock);
    const HidDescriptor descriptor = parse_report_descriptor(eye_tracker_descriptor());
    CHECK_THROWS_WITH(HidButtonBox(std::make_unique<InMemoryHidLine>(far), descriptor, "", clock),
                      Catch::Contains("neither buttons nor keys"));
}

TEST_CASE("an element of an array holds which usage is down, counted from its logical minimum", "[unit]") {
    DescriptorText text;
    // Two elements of which each is one of the keys a to f, told as 10 to 15; in a report with an id.
    text.page(0x01).open(0x06, 1).id(7).page(0x07);
    text.item(0x18, 0x04).item(0x28, 0x09).logical(10, 15).size(8, 2).input(0x00);
    text.close();
    HidButtons keys(parse_report_descriptor(text.bytes));
    CHECK(changes_of(keys, {7, 10, 0}) == "+a");
    CHECK(changes_of(keys, {7, 15, 10}) == "+f");
    CHECK(changes_of(keys, {7, 12, 9}) == "-a +c -f");
    CHECK(changes_of(keys, {7, 16, 0}) == "-c");  // beyond the last
    CHECK(changes_of(keys, {6, 10, 10}).empty()); // another report
    CHECK(changes_of(keys, {7, 11, 13}) == "+b +d");
    CHECK(changes_of(keys, {7, 11}).empty()); // cut off
    CHECK(changes_of(keys, {7, 0, 13}) == "-b");
}

TEST_CASE("keys have the names that stand on them, and others their numbers", "[unit]") {
    const std::pair<int, const char*> names[] = {{0x03, "key 3"}, {0x04, "a"},
                                                 {0x1D, "z"},     {0x1E, "1"},
                                                 {0x26, "9"},     {0x27, "0"},
                                                 {0x28, "enter"}, {0x29, "escape"},
                                                 {0x2C, "space"}, {0x4F, "right"},
                                                 {0x50, "left"},  {0x51, "down"},
                                                 {0x52, "up"},    {0x58, "keypad enter"},
                                                 {0x2D, "key 45"}};
    for (const auto& [key, name] : names)
        CHECK(hid_button_name(first_key_number + key) == name);
    CHECK(hid_button_name(first_key_number) == "key 0");
    CHECK(hid_button_name(first_key_number - 1) == std::to_string(first_key_number - 1));
}

TEST_CASE("usages of a thousand and some are buttons, of more none; held changes come in their order",
          "[unit]") {
    for (const int last : {1025, 1026}) { // from 1 on
        DescriptorText text;
        text.page(0x09)
            .open(1, 1)
            .item(0x18, 1, 2)
            .item(0x28, last, 2)
            .logical(1, last)
            .size(16, 1)
            .input(0x00)
            .close();
        HidButtons buttons(parse_report_descriptor(text.bytes));
        CHECK(buttons.has_any() == (last == 1025));
        if (last == 1025) // what a keyboard has for errors are buttons of a box
            for (const int number : {1, 2, 3, 4, 0x401})
                CHECK(changes_of(buttons, {number & 0xFF, number >> 8})
                          .starts_with(fmt::format("{}{}", number > 1 ? "-" : "+",
                                                   number > 1 && number < 5 ? number - 1
                                                   : number > 4             ? 4
                                                                            : 1)));
    }
    VirtualClock clock(SessionTime(1s));
    HidFarEnd far(clock);
    HidButtonBox box(std::make_unique<InMemoryHidLine>(far), parse_report_descriptor(game_pad_descriptor()),
                     "pad", clock);
    for (const std::size_t room : {1u, 2u, 3u, 7u}) {
        far.arriving.push_back({clock.now(), bytes_of({0, 0, 0xFF, 3})});
        far.arriving.push_back({clock.now(), bytes_of({0, 0, 0, 0})});
        std::string order;
        std::array<ButtonChange, 8> some;
        for (ButtonChange& change : some)
            change.button = 777;
        while (const std::size_t count = box.poll(std::span(some).first(room))) {
            REQUIRE(count <= room);
            for (std::size_t i = 0; i < count; ++i)
                order += fmt::format("{}{}", some[i].is_down ? '+' : '-', some[i].button);
            CHECK(some[room].button == 777);
        }
        CHECK(order == "+1+2+3+4+5+6+7+8+9+10-1-2-3-4-5-6-7-8-9-10");
    }
    CHECK(box.poll({}) == 0);
}
