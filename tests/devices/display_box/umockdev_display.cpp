// Runs under umockdev-wrapper, which puts a test bed in the place of /sys and of nodes in /dev: the program
// finds, opens and loses a USB serial port by the same calls as on a machine that has one.
#include <array>

#include <catch2/catch.hpp>

#include "devices/display_box/display_plus_plus_search.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"
#include "tests/devices/display_box/bits_box_model.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/umockdev_bed.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A USB device with a serial interface, as the kernel lists it.
std::string usb_serial_device(int number, const char* vendor, const char* product_id, const char* product) {
    const std::string usb = fmt::format("/devices/pci0000:00/0000:00:14.0/usb1/1-{}", number);
    return fmt::format(
        "P: {0}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor={1}\nA: idProduct={2}\n"
        "A: manufacturer=Overt Test\nA: product={3}\nA: serial=S{4}\n\n"
        "P: {0}/1-{4}:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nA: bInterfaceNumber=00\n\n"
        "P: {0}/1-{4}:1.0/tty/ttyACM{4}\nN: ttyACM{4}\nE: SUBSYSTEM=tty\nE: DEVNAME=/dev/ttyACM{4}\n"
        "E: MAJOR=166\nE: MINOR={4}\nA: dev=166:{4}\n\n",
        usb, vendor, product_id, product, number);
}

DisplayPlusPlusSettings patient() {
    DisplayPlusPlusSettings settings;
    settings.timeouts.reply = settings.timeouts.whole_reply =
        5s; // the device's thread may get no processor for long
    settings.settle = 60s;
    return settings;
}

} // namespace

TEST_CASE("a display box is found among USB serial devices, switched, read and switched back", "[unit]") {
    UmockdevBed bed;
    REQUIRE(umockdev_in_mock_environment()); // that is, under umockdev-wrapper
    bed.add(usb_serial_device(0, "0861", "1001", "ColorCAL"));
    bed.add(usb_serial_device(1, "1209", "b175", "a box of unknown number"));
    const auto ports = serial_ports();
    REQUIRE(ports.size() == 2);
    CHECK(describe(ports[0]) == "/dev/ttyACM0 (0861:1001 ColorCAL)");
    CHECK(ports[1].serial_number == "S1");

    SteadyClock clock;
    BitsBoxModel model;
    model.video = [](int, int pixel) { return RgbBytes{static_cast<std::uint8_t>(pixel), 0, 255}; };
    {
        const TerminalDevice device(
            bed.far_end("/dev/ttyACM1"),
            [&model](std::string_view bytes, double now_s) { return model.receive(bytes, now_s); },
            [&model](double now_s) { return model.streaming ? model.status_line(now_s) : ""; });
        const auto display =
            find_display_plus_plus(ports, std::nullopt, serial_port_opener(clock), clock, patient());
        CHECK(display->identity().port == "/dev/ttyACM1");
        CHECK(display->identity().serial_number == "DPP-0042");
        display->set_mode(BoxMode::color_plus_plus);
        CHECK(display->read_video_line(1, 256)[200] == RgbBytes{200, 0, 255});
        display->start_status();
        std::array<ArrivedStatus, 4> samples;
        std::size_t count = 0;
        for (const SessionTime give_up = clock.now() + 10s; count == 0 && clock.now() < give_up;) {
            clock.wait_until(clock.now() + 5ms);
            count = display->poll_status(samples);
        }
        CHECK(count > 0);
    }
    CHECK(model.mode == "BitsPlusPlus");
    CHECK_FALSE(model.streaming);
}

TEST_CASE("a display box that is pulled out of a running stream is lost", "[unit]") {
    UmockdevBed bed;
    bed.add(usb_serial_device(1, "1209", "b175", "a box"));
    SteadyClock clock;
    const int far_end = bed.far_end("/dev/ttyACM1");
    BitsBoxModel model;
    std::unique_ptr<DisplayPlusPlus> display;
    {
        const TerminalDevice device(
            far_end, [&model](std::string_view bytes, double now_s) { return model.receive(bytes, now_s); });
        display =
            find_display_plus_plus(serial_ports(), std::nullopt, serial_port_opener(clock), clock, patient());
        display->start_status();
    }
    close(far_end);
    std::array<ArrivedStatus, 4> samples;
    for (const SessionTime give_up = clock.now() + 10s; !display->lost() && clock.now() < give_up;) {
        display->poll_status(samples);
        clock.wait_until(clock.now() + 5ms);
    }
    CHECK(display->lost());
    CHECK_THROWS_AS(display->video_rate_hz(), DeviceError);
}
