#include "devices/usb/ftdi_line.h"

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("speeds of a serial chip are told as its maker's tables have them", "[unit]") {
    // FTDI application note AN232B-05, for chips of 3 MHz.
    CHECK(ftdi_speed(300) == FtdiSpeed{0x2710, 0});
    CHECK(ftdi_speed(1200) == FtdiSpeed{0x09C4, 0});
    CHECK(ftdi_speed(9600) == FtdiSpeed{0x4138, 0});
    CHECK(ftdi_speed(19200) == FtdiSpeed{0x809C, 0});
    CHECK(ftdi_speed(38400) == FtdiSpeed{0xC04E, 0});
    CHECK(ftdi_speed(57600) == FtdiSpeed{0xC034, 0});
    CHECK(ftdi_speed(115200) == FtdiSpeed{0x001A, 0});
    CHECK(ftdi_speed(230400) == FtdiSpeed{0x000D, 0});
    CHECK(ftdi_speed(460800) == FtdiSpeed{0x4006, 0});
    CHECK(ftdi_speed(921600) == FtdiSpeed{0x8003, 0});
    CHECK(ftdi_speed(3'000'000) == FtdiSpeed{0, 0});
    CHECK(ftdi_speed(2'000'000) == FtdiSpeed{1, 0});
    CHECK_FALSE(ftdi_speed(100));
    CHECK_FALSE(ftdi_speed(3'000'001));
}

TEST_CASE("each speed that a port may have is met within 3 percent", "[unit]") {
    constexpr int eighths[] = {0, 4, 2, 1, 3, 5, 6, 7}; // by the code of the fraction
    for (const int baud : {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600}) {
        const auto told = ftdi_speed(baud);
        REQUIRE(told);
        const int code = told->value >> 14 | told->index << 2;
        const double divisor = (told->value & 0x3FFF) + eighths[code] / 8.0;
        CHECK(3e6 / divisor == Approx(baud).epsilon(0.03));
    }
}
