/// Dials and 3D mice, by planted report bytes.
#include "devices/buttons/hid_knob.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "devices/buttons/box_times.h"
#include "devices/buttons/button_box_device.h"
#include "devices/buttons/hid_button_box.h"
#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A multi-axis controller with a button: all six axes in report 1, as newer ones have them, or translations
/// in report 1 and rotations in report 2; the button in report 3.
std::vector<std::byte> spacemouse_descriptor(bool is_older) {
    DescriptorText text;
    text.page(0x01).open(0x08, 1).open(0x00, 0).id(1);
    text.logical(-350, 350).size(16, is_older ? 3 : 6);
    for (int axis = 0x30; axis <= 0x35; ++axis) {
        if (is_older && axis == 0x33)
            text.input(0x02).close().open(0x00, 0).id(2);
        text.usage(axis);
    }
    text.input(0x02).close();
    text.page(0x09).id(3).item(0x18, 1).item(0x28, 2).logical(0, 1).size(1, 2).input(0x02).size(6, 1).input(
        0x03);
    return text.close().bytes;
}

/// A dial as a multi-axis controller with a button and relative counts of 8 bits.
std::vector<std::byte> dial_descriptor(int usage = 0x37, int flags = 0x06) {
    DescriptorText text;
    text.page(0x01).open(0x0E, 1).id(1).open(0x08, 0);
    text.page(0x09).usage(1).logical(0, 1).size(1, 1).input(0x02).size(7, 1).input(0x03);
    text.page(0x01).usage(usage).logical(-127, 127).size(8, 1).input(flags);
    return text.close().close().bytes;
}

constexpr ButtonBoxKind dial_kind = kind_called<ButtonBoxKind>("dial"),
                        spacemouse_kind = kind_called<ButtonBoxKind>("spacemouse");

ButtonBoxSettings knob_settings(ButtonBoxKind kind) {
    ButtonBoxSettings settings;
    settings.id = "knob";
    settings.kind = kind;
    return settings;
}

/// A knob, and what its reports did, as "turn tilt" or "+1", "-1" of a button.
struct KnobInHand {
    KnobInHand(std::vector<std::byte> descriptor, const ButtonBoxSettings& settings)
        : knob(std::make_unique<InMemoryHidLine>(far), parse_report_descriptor(descriptor), "a knob",
               settings, clock) {}

    /// After so long since the last.
    std::string after(SessionDuration time, std::vector<std::vector<std::byte>> reports = {}) {
        const SessionTime now = clock.now() + time;
        for (std::vector<std::byte>& report : reports)
            far.arriving.push_back({now, std::move(report)});
        clock.wait_until(now);
        std::array<ButtonChange, 32> changes;
        const std::size_t count = knob.poll(changes);
        std::string words;
        for (const ButtonChange& change : std::span(changes).first(count)) {
            last = change;
            words += (words.empty() ? "" : ", ") +
                     (change.is_turn() ? fmt::format("{} {}", change.turn_steps, change.tilt_steps)
                                       : fmt::format("{}{}", change.is_down ? "+" : "-", change.button));
        }
        return words;
    }

    VirtualClock clock{SessionTime(1s)};
    HidFarEnd far{clock};
    HidKnob knob;
    ButtonChange last;
};

/// A report of all axes; of those that matter Rx and Rz.
std::vector<std::byte> axes_report(int rx, int rz) {
    const auto low = [](int value) { return value & 0xFF; };
    const auto high = [](int value) { return (value >> 8) & 0xFF; };
    return bytes_of({1, 0x5E, 1, 0, 0, 0, 0, low(rx), high(rx), 0x5E, 1, low(rz), high(rz)});
}

} // namespace

TEST_CASE("a dial gives its counts as steps, with their signs, and its button", "[unit]") {
    KnobInHand dial(dial_descriptor(), knob_settings(dial_kind));
    CHECK(dial.knob.description().name == "dial");
    CHECK(dial.after(10ms).empty());
    CHECK(dial.after(10ms, {bytes_of({1, 0, 3})}) == "3 0");
    CHECK(dial.last.button == -1);
    CHECK(dial.last.at + dial.last.uncertainty >= dial.clock.now());
    CHECK(dial.after(10ms, {bytes_of({1, 0, 0xFF}), bytes_of({1, 0, 0x81})}) == "-1 0, -127 0");
    CHECK(dial.after(10ms, {bytes_of({1, 1, 2})}) == "2 0, +1"); // pressed and turned
    CHECK(dial.after(10ms, {bytes_of({1, 0, 0})}) == "-1");
    CHECK(dial.after(10ms, {bytes_of({2, 0, 5}), bytes_of({1})}).empty()); // another report, and one cut off

    ButtonBoxSettings fine = knob_settings(dial_kind);
    fine.steps_per_count = -0.25; // the other way round, four counts a step
    KnobInHand wheel(dial_descriptor(0x38), fine);
    CHECK(wheel.after(1ms, {bytes_of({1, 0, 3})}).empty());
    CHECK(wheel.after(1ms, {bytes_of({1, 0, 2})}) == "-1 0"); // 1.25 steps
    CHECK(wheel.after(1ms, {bytes_of({1, 0, 3})}) == "-1 0");
    wheel.far.arriving.push_back({wheel.clock.now(), bytes_of({1, 0, 100})});
    wheel.knob.begin(); // what was before a trial is forgotten
    CHECK(wheel.after(1ms, {bytes_of({1, 0, 3})}).empty());
    wheel.far.unplugged = true;
    CHECK(wheel.after(1ms).empty());
    CHECK(wheel.knob.lost());
}

TEST_CASE("a 3D mouse turns by its twist and tilts by its pitch, as long as it is held", "[unit]") {
    ButtonBoxSettings settings = knob_settings(spacemouse_kind);
    settings.full_turn_steps_s = 100.0;
    settings.full_tilt_steps_s = 50.0;
    settings.dead_zone = 0.2;
    KnobInHand mouse(spacemouse_descriptor(false), settings);
    CHECK(mouse.after(20ms, {axes_report(0, 350)}).empty()); // from now on
    CHECK(mouse.after(20ms, {axes_report(0, 350)}) == "2 0");
    CHECK(mouse.after(20ms) == "2 0"); // without a report of its own
    CHECK(mouse.after(20ms, {axes_report(0, -350)}) == "2 0");
    CHECK(mouse.after(20ms, {axes_report(350, 0)}) == "-2 0");
    CHECK(mouse.after(40ms, {axes_report(-350, 0)}) == "0 2");
    CHECK(mouse.after(40ms, {axes_report(0, 0)}) == "0 -2");
    CHECK(mouse.after(1s).empty()); // let go
    // Of its way 0.2 is none, and the rest goes from 0 to 1: 0.6 is half.
    CHECK(mouse.after(1ms, {axes_report(70, 69)}).empty());
    CHECK(mouse.after(90ms, {axes_report(0, 210)}).empty());
    CHECK(mouse.after(40ms, {axes_report(0, 0)}) == "2 0");
    // Beyond its range it is as far as it goes.
    CHECK(mouse.after(1ms, {axes_report(0, 3000)}).empty());
    CHECK(mouse.after(20ms, {axes_report(0, 0)}) == "2 0");
    // Both at once, and a button.
    CHECK(mouse.after(1ms, {axes_report(350, -350)}).empty());
    CHECK(mouse.after(40ms, {axes_report(0, 0), bytes_of({3, 0b10})}) == "-4 2, +2");
    CHECK(mouse.after(1ms, {bytes_of({3, 0})}) == "-2");
    // A report of the release that never comes: after a tenth of a second it stands.
    CHECK(mouse.after(1ms, {axes_report(0, 350)}).empty());
    CHECK(mouse.after(5s) == "10 0");
    CHECK(mouse.after(5s).empty());
    // What is left of a step goes with the release.
    CHECK(mouse.after(1ms, {axes_report(0, 350)}).empty());
    CHECK(mouse.after(8ms, {axes_report(0, 0)}).empty());
    CHECK(mouse.after(1ms, {axes_report(0, 350)}).empty());
    CHECK(mouse.after(8ms, {axes_report(0, 0)}).empty());
}

TEST_CASE("an older 3D mouse has its rotations in a report of their own", "[unit]") {
    ButtonBoxSettings settings = knob_settings(spacemouse_kind);
    settings.full_turn_steps_s = -100.0; // the other way round
    settings.full_tilt_steps_s = 0.0;    // it does not tilt
    KnobInHand mouse(spacemouse_descriptor(true), settings);
    const auto rotations = [](int low, int high) { return bytes_of({2, 0x5E, 1, 0, 0, low, high}); };
    CHECK(mouse.after(1ms, {bytes_of({1, 0x5E, 1, 0x5E, 1, 0x5E, 1}), rotations(0x5E, 1)}).empty());
    CHECK(mouse.after(50ms, {bytes_of({1, 0, 0, 0, 0, 0, 0})}) == "-5 0"); // translations change nothing
    CHECK(mouse.after(20ms, {rotations(0, 0)}) == "-2 0");
    CHECK(mouse.after(20ms).empty());
}

TEST_CASE("what is no knob is refused, and only those of their makers are 3D mice", "[unit]") {
    VirtualClock clock;
    HidFarEnd far(clock);
    const auto open = [&](std::vector<std::byte> descriptor, ButtonBoxKind kind) {
        return HidKnob(std::make_unique<InMemoryHidLine>(far), parse_report_descriptor(descriptor), "",
                       knob_settings(kind), clock);
    };
    CHECK_THROWS_WITH(open(game_pad_descriptor(), dial_kind), Catch::Contains("no dial or wheel"));
    CHECK_THROWS_WITH(open(dial_descriptor(0x37, 0x02), dial_kind),
                      Catch::Contains("no dial or wheel")); // absolute
    CHECK_THROWS_AS(open(dial_descriptor(), spacemouse_kind), DeviceError);
    DescriptorText mouse;
    mouse.page(0x01).open(0x02, 1).usage(0x38).logical(-127, 127).size(8, 1).input(0x06).close();
    CHECK_FALSE(is_dial(parse_report_descriptor(mouse.bytes))); // the wheel of a mouse is the window's
    CHECK(is_dial(parse_report_descriptor(dial_descriptor())));
    HidDeviceInfo device;
    device.vendor_id = 0x256f;
    device.usages = {{0x01, 0x08}};
    CHECK(is_spacemouse(device));
    device.usages = {{0x01, 0x02}}; // a mouse of theirs
    CHECK_FALSE(is_spacemouse(device));
    device.vendor_id = 0x046d;
    device.usages = {{0x01, 0x08}};
    CHECK(is_spacemouse(device));
    device.vendor_id = 0x1234;
    CHECK_FALSE(is_spacemouse(device));
}

TEST_CASE(
    "a knob's axis goes on as it is held, beyond its dead zone, for a tenth of a second, in whole steps",
    "[unit]") {
    const SessionTime begin(std::chrono::seconds(5));
    const auto steps_after = [&](double deflection, double dead_zone, SessionDuration held) {
        KnobAxis axis;
        axis.hold(deflection, 100.0, dead_zone, begin);
        axis.go_on(begin + held);
        return axis.take_steps();
    };
    using namespace std::chrono_literals;
    CHECK(steps_after(1.0, 0.0, 50ms) == 5);
    CHECK(steps_after(-1.0, 0.0, 50ms) == -5);
    CHECK(steps_after(0.5, 0.0, 100ms) == 5);
    CHECK(steps_after(1.0, 0.0, 100ms) == 10);
    CHECK(steps_after(1.0, 0.0, 5s) == 10); // a report of its release may have been lost
    CHECK(steps_after(0.6, 0.2, 100ms) == 5);
    CHECK(steps_after(0.2, 0.2, 100ms) == 0);
    CHECK(steps_after(0.1, 0.2, 100ms) == 0);
    CHECK(steps_after(1.0, 0.0, 9ms) == 0);
    KnobAxis axis;
    axis.hold(1.0, 100.0, 0.0, begin);
    axis.go_on(begin + 15ms);
    CHECK(axis.take_steps() == 1);
    axis.go_on(begin + 14ms); // no time goes back
    axis.hold(1.0, 100.0, 0.0, begin + 20ms);
    CHECK(axis.take_steps() == 1); // what was left of the first stayed
    axis.go_on(begin + 25ms);
    axis.hold(0.0, 100.0, 0.0, begin + 25ms);
    axis.hold(1.0, 100.0, 0.0, begin + 30ms);
    axis.go_on(begin + 36ms);
    CHECK(axis.take_steps() == 0); // and is gone when it is let go
    axis.add(0.4);
    CHECK(axis.take_steps() == 1);
    axis.add(2.5e6);
    CHECK(axis.take_steps() == 1'000'000);
    CHECK(axis.take_steps() == 1'000'000);
    axis.forget();
    CHECK(axis.take_steps() == 0);
    axis.add(-0.3);
    axis.add(-0.3);
    axis.add(-0.4);
    CHECK(axis.take_steps() == -1); // whose sum misses a step by its rounding
}

TEST_CASE("what a knob did is timed by when it was looked at before and by when it was fetched", "[unit]") {
    KnobInHand dial(dial_descriptor(), knob_settings(dial_kind));
    dial.after(10ms);
    const SessionTime looked = dial.clock.now();
    for (const auto& [report, words] : {std::pair(bytes_of({1, 0, 3}), "3 0"), {bytes_of({1, 1, 0}), "+1"}}) {
        const SessionTime before = dial.clock.now();
        CHECK(dial.after(8ms, {report}) == words);
        const SessionTime fetched = dial.clock.now();
        const ButtonChange wanted = BoxTimes::arrival(0, false, before, fetched, usb_transport);
        CHECK(dial.last.at == wanted.at);
        CHECK(dial.last.uncertainty == wanted.uncertainty);
        CHECK(dial.last.at < fetched);
        CHECK(dial.last.uncertainty > 4ms);
    }
    CHECK(looked < dial.clock.now());
    // More at once than are asked for come with the next calls, the first first.
    for (int i = 1; i <= 40; ++i)
        dial.far.arriving.push_back({dial.clock.now(), bytes_of({1, 1, i})});
    std::array<ButtonChange, 3> some;
    std::vector<int> turned;
    while (const std::size_t count = dial.knob.poll(some))
        for (std::size_t i = 0; i < count; ++i)
            turned.push_back(some[i].turn_steps);
    REQUIRE(turned.size() == 40);
    CHECK(turned.front() == 1);
    CHECK(turned.back() == 40);
}

TEST_CASE("of a knob's numbers those that it sends, that change, are one each and of its own page count",
          "[unit]") {
    const auto with = [](int usage, int flags, bool is_sent, int page = 0x01) {
        DescriptorText text;
        text.page(0x01).open(0x0E, 1).id(1).open(0x08, 0).page(page).usage(usage).logical(-127, 127).size(8,
                                                                                                          1);
        if (is_sent)
            text.input(flags);
        else
            text.feature(flags);
        return is_dial(parse_report_descriptor(text.close().close().bytes));
    };
    CHECK(with(0x37, 0x06, true));
    CHECK(with(0x38, 0x06, true));
    CHECK_FALSE(with(0x36, 0x06, true));
    CHECK_FALSE(with(0x39, 0x06, true));
    CHECK_FALSE(with(0x37, 0x06, false)); // a setting
    CHECK_FALSE(with(0x37, 0x07, true));  // constant
    CHECK_FALSE(with(0x37, 0x04, true));  // an array
    CHECK_FALSE(with(0x37, 0x02, true));  // absolute
    CHECK_FALSE(with(0x37, 0x06, true, 0x02));
}

TEST_CASE(
    "what a 3D mouse was held at is forgotten when a trial begins, and nothing is written beyond the room",
    "[unit]") {
    ButtonBoxSettings settings = knob_settings(spacemouse_kind);
    settings.full_turn_steps_s = settings.full_tilt_steps_s = 100.0;
    settings.dead_zone = 0.0;
    KnobInHand mouse(spacemouse_descriptor(false), settings);
    for (const auto& report : {axes_report(350, 0), axes_report(0, 350), axes_report(350, 350)}) {
        CHECK(mouse.after(1ms, {report}).empty());
        mouse.knob.begin();
        CHECK(mouse.after(50ms).empty());
    }
    KnobInHand dial(dial_descriptor(), knob_settings(dial_kind));
    for (const std::size_t room : {0u, 1u, 2u, 3u}) {
        dial.knob.begin();
        for (int i = 0; i < 5; ++i)
            dial.far.arriving.push_back({dial.clock.now(), bytes_of({1, i % 2 == 0 ? 1 : 0, 3})});
        std::array<ButtonChange, 5> changes;
        for (ButtonChange& change : changes)
            change.button = 777;
        CHECK(dial.knob.poll(std::span(changes).first(room)) == room);
        for (std::size_t i = 0; i < changes.size(); ++i)
            CHECK((changes[i].button == 777) == (i >= room));
    }
}

TEST_CASE("what is no box of its kind is said with its path and what it lacks, and one that is gone, too",
          "[unit]") {
    VirtualClock clock;
    HidFarEnd far(clock);
    const auto knob = [&](std::vector<std::byte> descriptor, ButtonBoxKind kind) {
        return HidKnob(std::make_unique<InMemoryHidLine>(far), parse_report_descriptor(descriptor), "",
                       knob_settings(kind), clock);
    };
    CHECK_THROWS_WITH(knob(game_pad_descriptor(), dial_kind),
                      "/dev/hidraw0 has no dial or wheel that tells turns.");
    CHECK_THROWS_WITH(knob(dial_descriptor(), spacemouse_kind),
                      "/dev/hidraw0 has no value of rotation about its own axis.");
    const auto box = [&](std::vector<std::byte> descriptor) {
        return HidButtonBox(std::make_unique<InMemoryHidLine>(far), parse_report_descriptor(descriptor), "",
                            clock);
    };
    DescriptorText mute;
    mute.page(0x01).open(0x02, 1).usage(0x38).logical(-127, 127).size(8, 1).input(0x06).close();
    CHECK_THROWS_WITH(box(mute.bytes), "/dev/hidraw0 has neither buttons nor keys.");
    // A thousand reports at most are read away when it begins.
    for (int i = 0; i < 1003; ++i)
        far.arriving.push_back({clock.now(), bytes_of({0, 0, 0, 0})});
    box(game_pad_descriptor());
    CHECK(far.arriving.size() == 3);
    far.unplugged = true;
    CHECK_THROWS_WITH(box(game_pad_descriptor()), "/dev/hidraw0 was unplugged.");
    CHECK_THROWS_WITH(knob(dial_descriptor(), dial_kind), "/dev/hidraw0 was unplugged.");
    // A CB6 is read through a box that a session may not have.
    CHECK_THROWS_WITH(button_box_device_of<kind_called<ButtonBoxKind>("cb6")>().open({{}, clock, nullptr}),
                      Catch::StartsWith("a CB6 is read through the Display++ or Bits#"));
}
