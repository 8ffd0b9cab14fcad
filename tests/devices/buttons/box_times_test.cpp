/// When a box's changes were, in numbers: by its clock, or by when they were fetched.
#include "devices/buttons/box_times.h"

#include <catch2/catch.hpp>

#include "devices/buttons/iolab_box.h"
#include "devices/buttons/xid_box.h"
#include "devices/buttons/xid_trigger.h"
#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"
#include "tests/devices/link/in_memory_line.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

constexpr SessionTime at(SessionDuration since_zero) { return SessionTime(since_zero); }

std::string little_endian(std::uint32_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

/// What was sent to a device of XID, which answers at once as it is told.
struct XidWire {
    VirtualClock clock{SessionTime(20s)};
    FarEnd far{clock};
    std::string heard, firmware = "2", clock_answer = "_e5" + little_endian(1000);
    std::vector<int> bauds;
    int speaks_at = 115200;
    std::string mode = "_xid0";

    XidWire() {
        far.port = "/dev/ttyUSB0";
        far.delay = 1ms;
        far.answer = [this](std::string_view bytes) -> std::string {
            if (bauds.back() != speaks_at)
                return "";
            heard += bytes;
            const auto is = [&](std::string_view command) { return heard.ends_with(command); };
            return is("_c1")   ? mode
                   : is("_d2") ? "2"
                   : is("_d3") ? "2"
                   : is("_d4") ? firmware
                   : is("_e5") ? clock_answer
                               : "";
        };
    }
    XidLine::Opener opener() {
        return [this](const std::string&, int baud) {
            bauds.push_back(baud);
            return std::make_unique<InMemoryLine>(far);
        };
    }
    void packet(int info, std::uint32_t ms) {
        far.send(clock.now(), std::string("k") + static_cast<char>(info) + little_endian(ms));
    }
};

} // namespace

TEST_CASE("a change without a clock was between two looks, and a transport's time before the second",
          "[unit]") {
    const ButtonChange change = BoxTimes::arrival(3, true, at(10ms), at(30ms), 2ms);
    CHECK(change.button == 3);
    CHECK(change.is_down);
    CHECK(change.at == at(19ms));
    CHECK(change.uncertainty == 11ms);
    CHECK_FALSE(change.device_time);
}

TEST_CASE("a change by a box's clock is known as well as its exchange, and its millisecond", "[unit]") {
    BoxTimes times;
    ButtonChange change = times.of(2, false, 1234, at(10ms), at(30ms));
    CHECK(change.button == 2);
    CHECK_FALSE(change.is_down);
    CHECK(change.device_time == BoxTime(1234ms));
    CHECK(change.at == at(30ms) - change.uncertainty); // nothing is known of its clock yet
    times.add_exchange(at(100ms), 50, at(104ms));
    change = times.of(2, false, 50, at(10ms), at(30ms));
    CHECK(change.at == at(102ms));
    CHECK(change.uncertainty >= 3ms);
    CHECK(change.uncertainty <= 3ms + 2us);
    change = times.of(2, false, 60, at(10ms), at(30ms));
    CHECK(change.at == at(112ms));
    CHECK(change.device_time == BoxTime(60ms));
    times.forget();
    change = times.of(2, true, 50, at(10ms), at(30ms));
    CHECK(change.at == at(30ms) - change.uncertainty);
}

TEST_CASE("a device of XID is looked for at five speeds, from the fastest of its makers on", "[unit]") {
    XidWire wire;
    wire.speaks_at = 38400;
    const XidLine line("/dev/ttyUSB0", wire.opener(), wire.clock);
    CHECK(wire.bauds == std::vector<int>{115200, 19200, 9600, 57600, 38400});
    CHECK(line.baud() == 38400);
    CHECK(line.identity().product == '2');
    CHECK(line.identity().model == '2');
    CHECK(line.identity().firmware == '2');
    // 200 ms for each that does not answer.
    CHECK(wire.clock.now() - SessionTime(20s) >= 800ms);
    CHECK(wire.clock.now() - SessionTime(20s) < 850ms);
    CHECK(wire.heard == "_c1_d2_d3_d4");
    XidWire other;
    other.mode = "_xid1"; // in another mode, it is set to the one in which keys are packets
    const XidLine set("/dev/ttyUSB0", other.opener(), other.clock);
    CHECK(other.heard == "_c1c10_d2_d3_d4");
    XidWire mute;
    mute.mode = "_ready";
    CHECK_THROWS_WITH(XidLine("/dev/ttyUSB9", mute.opener(), mute.clock),
                      Catch::Contains("Nothing that speaks XID answers at /dev/ttyUSB9"));
    CHECK(mute.bauds.size() == 5);
}

TEST_CASE("an XID box's keys come at their times, few at a time, and no key of another port", "[unit]") {
    XidWire wire;
    XidBox box("/dev/ttyUSB0", wire.opener(), wire.clock);
    CHECK(wire.heard == "_c1_d2_d3_d4e5_e5_e5_e5");
    CHECK(box.description().model == "/dev/ttyUSB0, product 2, model 2, firmware 2, 115200 baud");
    box.begin();
    CHECK(wire.heard.ends_with("e5_e5_e5_e5_e5_e5_e5"));
    wire.packet(0x30, 2000);
    wire.packet(0x51, 2010); // of another port
    wire.packet(0x40, 2020);
    wire.packet(0xF0, 2030);
    wire.clock.wait_until(wire.clock.now() + 5ms);
    std::array<ButtonChange, 3> changes;
    changes[1].button = 77;
    REQUIRE(box.poll(std::span(changes).first(1)) == 1);
    CHECK(changes[0].button == 1);
    CHECK(changes[0].is_down);
    CHECK(changes[0].device_time == BoxTime(2000ms));
    CHECK(changes[1].button == 77); // there was no room
    REQUIRE(box.poll(changes) == 2);
    CHECK((changes[0].button == 2 && !changes[0].is_down));
    CHECK((changes[1].button == 7 && changes[1].is_down));
    CHECK(changes[1].at - changes[0].at == 10ms);
    CHECK(box.poll(changes) == 0);
    // An answer that is none, or too short, is no reading of its clock.
    XidWire odd;
    odd.clock_answer = "_e6" + little_endian(1000);
    CHECK_FALSE(XidBox("p", odd.opener(), odd.clock).description().has_clock);
    odd.clock_answer = "_e5abc";
    CHECK_FALSE(XidBox("p", odd.opener(), odd.clock).description().has_clock);
}

TEST_CASE("an XID device that takes nothing more, and one that is unplugged, say which", "[unit]") {
    XidWire wire;
    XidLine line("/dev/ttyUSB0", wire.opener(), wire.clock);
    wire.far.takes_bytes = false;
    const SessionTime before = wire.clock.now();
    CHECK_THROWS_WITH(line.send("x"), "The device at /dev/ttyUSB0 takes no commands: time-out.");
    CHECK(wire.clock.now() - before == 200ms);
    wire.far.takes_bytes = true;
    // An answer is waited for as long as is said, and no byte more than is asked for is taken.
    wire.far.answer = [](std::string_view) { return std::string("abcdef"); };
    CHECK(line.ask("?", 4, 30ms) == "abcd");
    CHECK(line.ask("?", 8, 30ms) == "efabcdef");
    const SessionTime asked = wire.clock.now();
    CHECK(line.ask("?", 7, 30ms) == "abcdef");
    CHECK(wire.clock.now() - asked >= 30ms);
    CHECK(wire.clock.now() - asked < 31ms);
    line.flush();
    wire.far.unplugged = true;
    CHECK_THROWS_WITH(line.send("x"), Catch::Contains("takes no commands: unplugged by the test"));
}

TEST_CASE("an ioLab box's reports are read by their letters, and a report of another kind is none of them",
          "[unit]") {
    using Kind = IolabReport::Kind;
    for (const auto& [letter, kind] : {std::pair{'D', Kind::key_down},
                                       {'U', Kind::key_up},
                                       {'T', Kind::clock},
                                       {'Y', Kind::version},
                                       {'E', Kind::error},
                                       {'P', Kind::other}}) {
        const auto told = parse_iolab(bytes_of({letter, 0, 0, 7, 1, 2, 3, 4}));
        REQUIRE(told);
        CHECK(told->kind == kind);
        CHECK(told->ms == 0x01020304);
        CHECK(told->button == (kind == Kind::key_down || kind == Kind::key_up ? 8 : IolabReport().button));
    }
    // As many bytes as fit, and no more.
    const auto command = iolab_command('J', {1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(command[0] == std::byte{0});
    CHECK(command[1] == std::byte{'J'});
    for (std::size_t i = 2; i < 9; ++i)
        CHECK(command[i] == static_cast<std::byte>(i - 1));
}

TEST_CASE("an XID device takes wide commands from the second firmware on, and as a StimTracker", "[unit]") {
    for (const auto& [firmware, is_wide] :
         {std::pair{"0", false}, {"1", false}, {"2", true}, {"9", true}, {"A", false}}) {
        XidWire wire;
        wire.firmware = firmware;
        const XidTrigger trigger("/dev/ttyUSB0", wire.opener(), wire.clock);
        CAPTURE(firmware);
        CHECK(wire.heard.ends_with(is_wide ? std::string("mh\0\0", 4) : std::string("ah\xFF\0", 4)));
    }
}
