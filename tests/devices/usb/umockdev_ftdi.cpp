// Runs under umockdev-wrapper: a serial chip on USB that the kernel has no driver for, through libusb.
#include <catch2/catch.hpp>

#include "devices/buttons/xid_box.h"
#include "devices/host/clocks.h"
#include "devices/usb/serial_line.h"
#include "experiment/base/error.h"
#include "tests/devices/usb/usb_chip.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const std::string address = "usb:0403:f1c0:AB12";

std::string read_all(ByteTransport& line, const Clock& clock, std::size_t wanted) {
    std::string all;
    std::array<char, 50> some{};
    const SessionTime deadline = clock.now() + 2s;
    while (all.size() < wanted && clock.now() < deadline)
        all.append(some.data(), line.read(some, deadline));
    return all;
}

} // namespace

TEST_CASE("a serial chip without a port of the system is found and speaks both ways") {
    SteadyClock clock;
    UsbChip chip([](const std::string& bytes, int) { return bytes; });
    const std::vector<FtdiChip> chips = ftdi_chips();
    REQUIRE(chips.size() == 1);
    CHECK(chips[0].address() == address);
    CHECK(describe(chips[0]) == address + " (RB-740)");
    CHECK_FALSE(chips[0].has_tty);

    const auto line = open_serial_line("usb:0403:f1c0", clock, 19200);
    CHECK(chip.last_request(3) == std::pair(0x809C, 0)); // its speed
    CHECK(chip.last_request(9).first == 1);              // a millisecond until it hands over
    CHECK(chip.last_request(4) == std::pair(8, 1));
    CHECK(chip.last_request(9) == std::pair(1, 1));
    CHECK(chip.last_request(2) == std::pair(0, 1));      // no flow control
    CHECK(chip.last_request(1) == std::pair(0x0303, 1)); // both lines up
    CHECK(chip.last_request(0) == std::pair(2, 1));      // what was leaving is gone, at last
    CHECK(line->name() == "usb:0403:f1c0");
    CHECK(line->loss().empty());
    std::array<char, 8> none{};
    CHECK(line->read(none, clock.now() - 1ms) == 0);
    CHECK(line->read(none, clock.now() + 20ms) == 0);
    // Longer than a packet: the status bytes are taken out of each.
    std::string told;
    for (int i = 0; i < 700; ++i)
        told += static_cast<char>('a' + i % 26);
    CHECK(line->write(told, clock.now() + 1s));
    CHECK(read_all(*line, clock, told.size()) == told);

    CHECK_FALSE(line->lost());
    chip.unplug();
    CHECK(line->read(none, clock.now() + 500ms) == 0);
    CHECK(line->lost());
    CHECK_THAT(line->loss(), Contains("No such device"));
    CHECK_FALSE(line->write("x", clock.now() + 100ms));
}

TEST_CASE("a box of Cedrus answers over USB at the speed that it is set to") {
    SteadyClock clock;
    std::string heard;
    UsbChip chip([&](const std::string& bytes, int speed) -> std::string {
        if (speed != 0x809C) // 19200 baud
            return "";
        heard += bytes;
        const auto is = [&](std::string_view command) { return heard.ends_with(command); };
        return is("_c1")                             ? "_xid0"
               : is("_d2") || is("_d3") || is("_d4") ? "2"
               : is("_e5")                           ? std::string("_e5\x10\x27\0\0", 7)
                                                     : "";
    });
    XidBox box(
        address, [&](const std::string& port, int baud) { return open_serial_line(port, clock, baud); },
        clock);
    CHECK_THAT(box.description().model, Contains(address) && Contains("model 2") && Contains("19200 baud"));
    chip.say(std::string("k\x50\x20\x27\0\0", 6) + std::string("k\x40\x70\x27\0\0", 6));
    std::array<ButtonChange, 4> changes{};
    std::size_t count = 0;
    for (int i = 0; i < 500 && count < 2; ++i) {
        count += box.poll(std::span(changes).subspan(count));
        clock.wait_until(clock.now() + 1ms);
    }
    REQUIRE(count == 2);
    CHECK((changes[0].is_down && !changes[1].is_down));
    CHECK(box.button_name(changes[0].button) == box.button_name(changes[1].button));
}

TEST_CASE(
    "a chip that is not there, that the kernel has, or that is named wrongly is refused with a remedy") {
    SteadyClock clock;
    {
        UsbChip chip([](const std::string&, int) { return ""; }, "ftdi_sio");
        CHECK(ftdi_chips().at(0).has_tty);
        CHECK_THROWS_WITH(FtdiLine(address, clock), Contains("name that, such as /dev/ttyUSB0"));
    }
    UsbChip chip([](const std::string&, int) { return ""; });
    CHECK_THROWS_WITH(FtdiLine("usb:0403:6001", clock),
                      Contains("No USB serial chip usb:0403:6001 is plugged in") && Contains("f1c0:AB12"));
    CHECK_THROWS_WITH(FtdiLine("usb:0403:f1c0:ZZ", clock), Contains("is plugged in"));
    for (const char* const wrong : {"usb:", "usb:0403", "usb:0403:1", "usb:1234:6001", "usb:0403:60011"})
        CHECK_THROWS_AS(FtdiLine(wrong, clock), InputError);
    CHECK_THROWS_WITH(FtdiLine(address, clock, 4'000'000), Contains("184 to 3,000,000"));
}
