#include "devices/buttons/iolab_box.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A box in memory, whose clock began at its reset.
struct IolabModel {
    VirtualClock clock{SessionTime(10s)};
    HidFarEnd far{clock};
    SessionTime zero;
    SessionDuration delay = 3ms;
    bool answers_time = true;

    IolabModel() {
        far.on_write = [this](std::span<const std::byte> report) {
            const char command = static_cast<char>(report[1]);
            if (command == 'Y')
                reply(bytes_of({'Y', 0, 2, 1, 1, 0, 0, 0}));
            if (command == 'R')
                zero = clock.now();
            if (command == 'T' && answers_time)
                reply(stamped('T', 0, clock.now()));
        };
    }
    std::vector<std::byte> stamped(char id, int key, SessionTime at) const {
        const auto ms = static_cast<std::uint32_t>((at - zero) / 1ms);
        return bytes_of({id, 0, 0, key, static_cast<int>(ms >> 24), static_cast<int>(ms >> 16 & 0xFF),
                         static_cast<int>(ms >> 8 & 0xFF), static_cast<int>(ms & 0xFF)});
    }
    void reply(std::vector<std::byte> report) {
        far.arriving.push_back({clock.now() + delay, std::move(report)});
    }
    std::unique_ptr<HidLine> line() { return std::make_unique<InMemoryHidLine>(far); }
    bool was_told(std::initializer_list<int> bytes) const {
        return std::ranges::find(far.written, bytes_of(bytes)) != far.written.end();
    }
};

} // namespace

TEST_CASE("reports of an ioLab box have their numbers with the highest byte first", "[unit]") {
    const auto down = parse_iolab(bytes_of({'D', 0, 0, 3, 0x01, 0x02, 0x03, 0x04}));
    REQUIRE(down);
    CHECK(down->kind == IolabReport::Kind::key_down);
    CHECK(down->button == 4);
    CHECK(down->ms == 0x01020304);
    CHECK(parse_iolab(bytes_of({'U', 0, 0, 0, 0, 0, 0, 9}))->kind == IolabReport::Kind::key_up);
    CHECK(parse_iolab(bytes_of({'T', 5, 0, 0, 0, 0, 4, 0xD2}))->ms == 1234);
    CHECK(parse_iolab(bytes_of({'H', 0, 0, 0, 0, 0, 0, 0}))->kind == IolabReport::Kind::other);
    CHECK_FALSE(parse_iolab(bytes_of({'D', 0, 0, 3, 0, 0, 0})));
    CHECK_FALSE(parse_iolab({}));
    CHECK(iolab_command('H', {0x75, 0x30}) ==
          std::array<std::byte, 9>{std::byte{0}, std::byte{'H'}, std::byte{0x75}, std::byte{0x30}});
}

TEST_CASE("an ioLab box is set up as its maker's library does", "[unit]") {
    IolabModel model;
    IolabBox box(model.line(), model.clock);
    CHECK(model.was_told({0, 'W', 0, 0, 0, 0, 0, 0, 0}));
    CHECK(model.was_told({0, 'H', 0x75, 0x30, 0, 0, 0, 0, 0}));
    CHECK(model.was_told({0, 'J', 0, 20, 5, 20, 5, 20, 5}));
    CHECK(model.was_told({0, 'M', 0, 0x0C, 0xFF, 0, 0, 0, 0}));
    CHECK(model.was_told({0, 'R', 0, 0, 0, 0, 0, 0, 0}));
    CHECK(model.was_told({0, 'Q', 0, 0, 0, 0, 0, 0, 0}));
    CHECK(box.description().has_clock);
    CHECK(box.button_name(3) == "3");
    const auto asked = [&] {
        return std::ranges::count(model.far.written, bytes_of({0, 'T', 0, 0, 0, 0, 0, 0, 0}));
    };
    CHECK(asked() == 3); // its clock is read three times, and before each trial
    box.begin();
    CHECK(asked() == 6);
}

TEST_CASE(
    "presses of an ioLab box are timed by its clock, within what is stated, however late they are fetched",
    "[unit]") {
    IolabModel model;
    IolabBox box(model.line(), model.clock);
    model.clock.wait_until(model.clock.now() + 777us); // in no step with the box's milliseconds
    box.begin();
    std::array<ButtonChange, 4> changes;
    CHECK(box.poll(changes) == 0);
    for (const SessionDuration late : {5ms, 900ms}) {
        const SessionTime pressed = model.clock.now() + 123456us, released = pressed + 80ms;
        model.far.arriving.push_back({pressed + 4ms, model.stamped('D', 6, pressed)});
        model.far.arriving.push_back({released + 4ms, model.stamped('U', 6, released)});
        model.clock.wait_until(released + 4ms + late);
        REQUIRE(box.poll(changes) == 2);
        CHECK(changes[0].button == 7);
        CHECK(changes[0].is_down);
        CHECK_FALSE(changes[1].is_down);
        CHECK(changes[0].device_time);
        CHECK(changes[0].at - changes[0].uncertainty <= pressed);
        CHECK(changes[0].at + changes[0].uncertainty >= pressed);
        CHECK(changes[1].at - changes[1].uncertainty <= released);
        CHECK(changes[1].at + changes[1].uncertainty >= released);
        CHECK(changes[0].uncertainty < 6ms);
    }
}

TEST_CASE("what was pressed before a trial of an ioLab box is forgotten", "[unit]") {
    IolabModel model;
    IolabBox box(model.line(), model.clock);
    model.far.arriving.push_back({model.clock.now(), model.stamped('D', 0, model.clock.now())});
    box.begin();
    std::array<ButtonChange, 4> changes;
    CHECK(box.poll(changes) == 0);
}

TEST_CASE("more presses than there is room for come with the next call", "[unit]") {
    IolabModel model;
    IolabBox box(model.line(), model.clock);
    box.begin();
    for (int key = 0; key < 5; ++key)
        model.far.arriving.push_back({model.clock.now(), model.stamped('D', key, model.clock.now())});
    std::array<ButtonChange, 3> changes;
    REQUIRE(box.poll(changes) == 3);
    CHECK(changes[2].button == 3);
    REQUIRE(box.poll(changes) == 2);
    CHECK(changes[1].button == 5);
}

TEST_CASE("an ioLab box that is none, is mute or unplugged is told so", "[unit]") {
    IolabModel model;
    SECTION("none") {
        model.far.on_write = nullptr;
        CHECK_THROWS_WITH(IolabBox(model.line(), model.clock),
                          Catch::Contains("does not answer as an ioLab"));
        CHECK(model.clock.now() < SessionTime(11s));
    }
    SECTION("mute") {
        model.answers_time = false;
        CHECK_THROWS_WITH(IolabBox(model.line(), model.clock), Catch::Contains("does not tell its time"));
    }
    SECTION("unplugged") {
        IolabBox box(model.line(), model.clock);
        model.far.unplugged = true;
        std::array<ButtonChange, 3> changes;
        CHECK(box.poll(changes) == 0);
        CHECK(box.lost());
        CHECK_THROWS_AS(box.begin(), DeviceError);
    }
}

TEST_CASE("answers of an ioLab box are found behind what else it says, and a lost one is not waited for",
          "[unit]") {
    IolabModel model;
    const auto answer = model.far.on_write;
    bool unplugs = false;
    model.far.on_write = [&](std::span<const std::byte> report) {
        model.reply(model.stamped('D', 2, model.clock.now()));
        model.reply(bytes_of({'E', 0}));
        answer(report);
        model.far.unplugged = unplugs;
    };
    IolabBox box(model.line(), model.clock);
    CHECK(box.description().has_clock);
    CHECK_NOTHROW(box.begin());
    // At the first question it is pulled out: time does not go on.
    unplugs = true;
    const SessionTime before = model.clock.now();
    CHECK_THROWS_AS(IolabBox(model.line(), model.clock), DeviceError);
    CHECK(model.clock.now() - before < 100ms);
}
