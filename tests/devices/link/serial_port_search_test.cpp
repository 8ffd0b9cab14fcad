/// Serial ports by what the system says of them in folders of its own, and what stands in the words for
/// people.
#include "devices/link/serial_port_search.h"

#include <catch2/catch.hpp>

#include "devices/display_box/bits_protocol.h"
#include "devices/link/byte_transport.h"
#include "devices/link/text_line.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
namespace fs = std::filesystem;

TEST_CASE("ports of a kind are found by number, with what the USB device above them says", "[unit]") {
    const TemporaryFolder root;
    const auto put = [&](const std::string& file, const std::string& text) {
        fs::create_directories((root.path() / file).parent_path());
        root.file(file, text);
    };
    for (const char* const node : {"ttyUSB0", "ttyUSB2", "ttyUSB10", "ttyACM0", "ttyUSBx", "ttyUSB"})
        put(std::string("dev/") + node, "");
    // A tty within an interface within a device, as the kernel has them; its number 3 has no node.
    const std::string device = "sys/devices/usb1/1-2/";
    put(device + "idVendor", "0403\n");
    put(device + "idProduct", "6001\n");
    put(device + "manufacturer", "FTDI\n");
    put(device + "product", "Cable\n");
    put(device + "serial", "A1\n");
    put(device + "1-2:1.0/ttyUSB2/latency_timer", "16\n");
    put(device + "1-2:1.0/ttyUSB2/tty/ttyUSB2/dev", "188:2\n");
    fs::create_directories(root.path() / "sys/class/tty");
    fs::create_directory_symlink(root.path() / (device + "1-2:1.0/ttyUSB2/tty/ttyUSB2"),
                                 root.path() / "sys/class/tty/ttyUSB2");
    fs::create_directory_symlink(root.path() / "nowhere", root.path() / "sys/class/tty/ttyUSB3");
    const auto ports = serial_ports(root.path() / "dev", root.path() / "sys", "ttyUSB");
    REQUIRE(ports.size() == 3);
    CHECK(ports[0].path == (root.path() / "dev/ttyUSB0").string());
    CHECK_FALSE(ports[0].vendor_id);
    CHECK(ports[1].path == (root.path() / "dev/ttyUSB2").string());
    CHECK(ports[1].vendor_id == 0x0403);
    CHECK(ports[1].product_id == 0x6001);
    CHECK(ports[1].manufacturer == "FTDI");
    CHECK(ports[1].product == "Cable");
    CHECK(ports[1].serial_number == "A1");
    CHECK(ports[1].latency_timer_ms == 16);
    CHECK(ports[2].path == (root.path() / "dev/ttyUSB10").string());
    CHECK(serial_ports(root.path() / "dev", root.path() / "sys").size() == 1);
    CHECK(serial_ports(root.path() / "none", root.path() / "none").empty());
}

TEST_CASE("a port is described by what it says of itself, and told of only where it gathers bytes",
          "[unit]") {
    SerialPortInfo port{"/dev/ttyUSB2"};
    CHECK(describe(port) == "/dev/ttyUSB2");
    port.product = "Cable";
    CHECK(describe(port) == "/dev/ttyUSB2 (Cable)");
    port.vendor_id = 0x403;
    CHECK(describe(port) == "/dev/ttyUSB2 (Cable)"); // numbers come in pairs
    port.product_id = 0x6001;
    CHECK(describe(port) == "/dev/ttyUSB2 (0403:6001 Cable)");
    port.product.clear();
    CHECK(describe(port) == "/dev/ttyUSB2 (0403:6001)");
    CHECK(latency_note(port).empty());
    port.latency_timer_ms = 1;
    CHECK(latency_note(port).empty());
    port.latency_timer_ms = 2;
    CHECK_THAT(latency_note(port),
               Catch::Contains("for up to 2 ms") && Catch::Contains("devices/ttyUSB2/latency_timer"));
}

TEST_CASE("numbers in lines are decimal, whole and finite, and bytes are shown as they can be read",
          "[unit]") {
    CHECK(decimal_number("1.5") == 1.5);
    CHECK(decimal_number("-0.25") == -0.25);
    for (const char* const none : {"", " 1", "1 ", "1e3", "0x1", "inf", "nan", "1.5.2", "+1"})
        CHECK_FALSE(decimal_number(none));
    CHECK(printable("a~ \x1f\x7f\xff") == "a~ \\x1f\\x7f\\xff");
    CHECK(printable("abcd", 4) == "abcd");
    CHECK(printable("abcde", 4) == "…bcde");
}

TEST_CASE("a reply of a box is the last of its name in a line, with a semicolon behind it", "[unit]") {
    CHECK(bits_reply("#Name;1;2;", "Name") == "1;2;");
    CHECK(bits_reply("x#Name;1;#Name;2;", "Name") == "2;");
    CHECK(bits_reply("#Name;1;#Other;2;", "Name") == "1;#Other;2;");
    CHECK(bits_reply("#Name;", "Name") == "");
    for (const char* const none :
         {"", "#", "#Name", "#Names;1;", "#Nam;1;", "Name;1;", "#name;1;", "#Other;1;"})
        CHECK_FALSE(bits_reply(none, "Name"));
    CHECK(bits_command("Stop", "") == "$Stop\r");
    CHECK(bits_command("Gamma", "a.txt") == "$Gamma=[a.txt]\r");
    CHECK(bits_fields(" a ;\tb;;c") == std::vector<std::string_view>{"a", "b", "", "c"});
    CHECK(bits_fields("a;") == std::vector<std::string_view>{"a"});
    CHECK(bits_fields("").empty());
    const VideoLine line = parse_video_line("0;128;255;1;2;3", 2);
    REQUIRE(line.pixels.size() == 2);
    CHECK(line.fault.empty());
    CHECK(line.pixels[0] == RgbBytes{0, 128, 255});
    CHECK(line.pixels[1] == RgbBytes{1, 2, 3});
    CHECK(parse_video_line("0;1;2;3", 1).fault == "4 numbers came for 1 pixels, not 3");
    CHECK(parse_video_line("0;1;256", 1).fault == "number 3 of 3 is \"256\", not 0 to 255");
}
