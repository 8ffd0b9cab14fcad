#include "devices/link/serial_port.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <filesystem>
#include <optional>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <linux/ppdev.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "devices/display_box/display_plus_plus.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port_search.h"
#include "devices/triggers/parallel_trigger.h"
#include "experiment/base/error.h"
#include "tests/devices/display_box/bits_box_model.h"
#include "tests/devices/link/answered_ioctl.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// The flags of a chip's driver, behind every terminal while there are any: one of the kernel's own has none.
std::optional<int> chip_flags;

} // namespace

/// Takes the place of the C library's for this program, and answers for the chip.
extern "C" [[gnu::no_sanitize("thread")]] int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list rest;
    va_start(rest, request);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    if (answer_to_ioctl)
        if (const std::optional<int> answer = answer_to_ioctl(request, argument)) {
            errno = *answer < 0 ? -*answer : errno;
            return *answer < 0 ? -1 : *answer;
        }
    if (chip_flags && (request == TIOCGSERIAL || request == TIOCSSERIAL)) {
        auto& state = *static_cast<serial_struct*>(argument);
        if (request == TIOCGSERIAL) {
            state = {};
            state.flags = *chip_flags;
        } else {
            chip_flags = state.flags;
        }
        return 0;
    }
    return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
}

namespace {

std::string read_some(ByteTransport& port, const Clock& clock, std::size_t wanted) {
    std::string text;
    std::array<char, 64> bytes{};
    const SessionTime deadline = clock.now() + 5s;
    while (text.size() < wanted && !port.lost() && clock.now() < deadline)
        text.append(bytes.data(), port.read(bytes, deadline));
    return text;
}

} // namespace

TEST_CASE("a serial port carries every byte both ways unchanged", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    SerialPort port(terminal.path(), clock);
    std::string all;
    for (int i = 0; i < 256; ++i)
        all += static_cast<char>(i);
    REQUIRE(port.write(all, clock.now() + 5s));
    std::array<char, 256> there{};
    for (std::size_t count = 0; count < there.size();) {
        const ssize_t n = read(terminal.master(), there.data() + count, there.size() - count);
        REQUIRE(n > 0);
        count += static_cast<std::size_t>(n);
    }
    CHECK(std::string(there.begin(), there.end()) == all);
    REQUIRE(write(terminal.master(), all.data(), all.size()) == 256);
    CHECK(read_some(port, clock, 256) == all);
}

TEST_CASE("the driver of a serial chip is asked for low latency, and keeps what else it was told", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    const int low = static_cast<int>(ASYNC_LOW_LATENCY),
              others = static_cast<int>(ASYNC_SPD_HI | ASYNC_SKIP_TEST);
    for (const int before : {others, others | low}) {
        chip_flags = before;
        const SerialPort port(terminal.path(), clock);
        const int after = chip_flags.value_or(0);
        chip_flags.reset();
        CHECK(after == (others | low));
    }
    CHECK_NOTHROW(SerialPort(terminal.path(), clock)); // of a terminal, which has no such thing
}

TEST_CASE("a serial port waits no longer than the deadline and not at all for one that is past", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    SerialPort port(terminal.path(), clock);
    std::array<char, 8> bytes{};
    const SessionTime deadline = clock.now() + 30ms;
    CHECK(port.read(bytes, deadline) == 0);
    CHECK(clock.now() >= deadline);
    CHECK(port.read(bytes, SessionTime()) == 0);
    CHECK_FALSE(port.lost());
}

TEST_CASE("what nobody takes is not written for ever", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    SerialPort port(terminal.path(), clock);
    CHECK_FALSE(port.write(std::string(1 << 20, 'x'), clock.now() + 50ms));
    CHECK_FALSE(port.lost());
}

TEST_CASE("a serial port belongs to one program at a time", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    {
        const SerialPort port(terminal.path(), clock);
        CHECK_THROWS_WITH(SerialPort(terminal.path(), clock),
                          Contains(terminal.path()) && Contains("another program has the port open"));
    }
    CHECK_NOTHROW(SerialPort(terminal.path(), clock));
}

TEST_CASE("a port that is not there or is no tty is refused with its name and a remedy", "[unit]") {
    const SteadyClock clock;
    const TemporaryFolder folder;
    const auto file = folder.file("ttyACM0", "");
    CHECK_THROWS_WITH(SerialPort(file.string(), clock),
                      Contains(file.string()) && Contains("not a serial port"));
    CHECK_THROWS_WITH(SerialPort((folder.path() / "ttyACM9").string(), clock),
                      Contains("ttyACM9 cannot be opened") && Contains("switched on"));
}

TEST_CASE("a port without rights names the rule that gives them", "[unit]") {
    Terminal terminal;
    SteadyClock clock;
    REQUIRE(chmod(terminal.path().c_str(), 0) == 0);
    // Root may open everything: as nobody.
    const bool is_root = geteuid() == 0;
    if (is_root)
        REQUIRE(seteuid(65534) == 0);
    std::string said;
    try {
        SerialPort port(terminal.path(), clock);
    } catch (const DeviceError& error) {
        said = error.what();
    }
    if (is_root)
        REQUIRE(seteuid(0) == 0);
    CHECK_THAT(said,
               Contains(terminal.path()) && Contains("assets/udev/70-overt.rules") && Contains("dialout"));
}

TEST_CASE("the search lists ports behind chips for serial lines when asked for them", "[unit]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "dev");
    for (const char* name : {"ttyUSB1", "ttyUSB0", "ttyACM0", "ttyUSBx"})
        folder.file(std::string("dev/") + name, "");
    const auto ports = serial_ports(folder.path() / "dev", folder.path() / "sys", "ttyUSB");
    REQUIRE(ports.size() == 2);
    CHECK(ports[0].path.ends_with("ttyUSB0"));
    CHECK(ports[1].path.ends_with("ttyUSB1"));
    CHECK(serial_ports(folder.path() / "dev", folder.path() / "sys").size() == 1);
}

TEST_CASE("a port whose device hangs up is lost after its last bytes", "[unit]") {
    const SteadyClock clock;
    Terminal terminal;
    SerialPort port(terminal.path(), clock);
    REQUIRE(write(terminal.master(), "bye", 3) == 3);
    CHECK(read_some(port, clock, 3) == "bye");
    terminal.hang_up();
    std::array<char, 8> bytes{};
    CHECK(port.read(bytes, clock.now() + 5s) == 0);
    CHECK(port.lost());
    CHECK_FALSE(port.loss().empty());
    CHECK_FALSE(port.write("x", clock.now() + 5s));
}

TEST_CASE("a whole conversation with a display box goes over a terminal line", "[unit]") {
    SteadyClock clock;
    Terminal terminal;
    BitsBoxModel model;
    model.video = [](int line, int pixel) {
        return RgbBytes{static_cast<std::uint8_t>(line), static_cast<std::uint8_t>(pixel), 7};
    };
    {
        const TerminalDevice device(
            terminal.master(),
            [&model](std::string_view bytes, double now_s) { return model.receive(bytes, now_s); },
            [&model](double now_s) { return model.streaming ? model.status_line(now_s) : ""; });
        DisplayPlusPlusSettings settings;
        settings.timeouts.reply = settings.timeouts.whole_reply =
            20s; // the device's thread may get no processor for long
        settings.timeouts.quiet = 250ms;
        settings.settle = 60s;
        DisplayPlusPlus display(std::make_unique<SerialPort>(terminal.path(), clock), clock, settings);
        CHECK(display.identity().product == "Display++");
        CHECK(display.identity().serial_number == "DPP-0042");
        CHECK(display.identity().port == terminal.path());
        display.set_mode(BoxMode::mono_plus_plus);
        const auto line = display.read_video_line(9, 1920);
        CHECK(line[255] == RgbBytes{9, 255, 7});
        const BoxClockPair first = display.read_clocks(), second = display.read_clocks();
        CHECK(first.before < first.after);
        CHECK(first.other < second.other);
        // The box's clock and ours are the same here: what lies between two readings must agree within their
        // widths.
        CHECK(to_seconds(second.after - first.before) >= to_seconds(second.other) - to_seconds(first.other));
        CHECK(to_seconds(second.before - first.after) <= to_seconds(second.other) - to_seconds(first.other));
    }
    CHECK(model.mode == "BitsPlusPlus");
}

TEST_CASE("the search lists ttyACM ports by number with what USB says of them", "[unit]") {
    const TemporaryFolder folder;
    const auto& root = folder.path();
    folder.file("dev/ttyACM10", "");
    folder.file("dev/ttyACM2", "");
    folder.file("dev/ttyACM3", ""); // a node without an entry in sysfs
    folder.file("dev/ttyUSB0", "");
    folder.file("dev/ttyACMx", "");
    folder.file("sys/devices/usb1/1-6/idVendor", "0861\n");
    folder.file("sys/devices/usb1/1-6/idProduct", "100a\n");
    folder.file("sys/devices/usb1/1-6/product", "A Box\n");
    folder.file("sys/devices/usb1/1-6/serial", "42\n");
    folder.file("sys/devices/usb1/1-6/1-6:1.0/tty/ttyACM10/dev", "166:10\n");
    folder.file("sys/devices/other/tty/ttyACM2/dev", "166:2\n");
    folder.file("sys/devices/other/tty/ttyACM7/dev", "166:7\n"); // an entry without a node
    std::filesystem::create_directories(root / "sys/class/tty");
    for (const char* target : {"usb1/1-6/1-6:1.0/tty/ttyACM10", "other/tty/ttyACM2", "other/tty/ttyACM7"}) {
        const std::filesystem::path entry(target);
        std::filesystem::create_directory_symlink(root / "sys/devices" / entry,
                                                  root / "sys/class/tty" / entry.filename());
    }
    const auto ports = serial_ports(root / "dev", root / "sys");
    REQUIRE(ports.size() == 3);
    CHECK(ports[0].path == (root / "dev/ttyACM2").string());
    CHECK_FALSE(ports[0].vendor_id);
    CHECK(ports[1].path == (root / "dev/ttyACM3").string());
    CHECK(ports[2].vendor_id == crs_vendor_id);
    CHECK(ports[2].product_id == 0x100a);
    CHECK(ports[2].serial_number == "42");
    CHECK_THAT(describe(ports[2]), Contains("ttyACM10 (0861:100a A Box)"));
    CHECK(latency_note(ports[2]).empty());
    CHECK(serial_ports(root / "nowhere", root / "neither").empty());
    // A chip of FTDI keeps its latency timer beside the port, within the USB device.
    folder.file("sys/devices/usb1/1-7/idVendor", "0403\n");
    folder.file("sys/devices/usb1/1-7/1-7:1.0/ttyUSB0/latency_timer", "16\n");
    folder.file("sys/devices/usb1/1-7/1-7:1.0/ttyUSB0/tty/ttyUSB0/dev", "188:0\n");
    std::filesystem::create_directory_symlink(root / "sys/devices/usb1/1-7/1-7:1.0/ttyUSB0/tty/ttyUSB0",
                                              root / "sys/class/tty/ttyUSB0");
    const auto chips = serial_ports(root / "dev", root / "sys", "ttyUSB");
    REQUIRE(chips.size() == 1);
    CHECK(chips[0].latency_timer_ms == 16);
    CHECK_THAT(latency_note(chips[0]),
               Contains("up to 16 ms") && Contains("/sys/bus/usb-serial/devices/ttyUSB0/latency_timer"));
    folder.file("sys/devices/usb1/1-7/1-7:1.0/ttyUSB0/latency_timer", "1\n");
    CHECK(latency_note(serial_ports(root / "dev", root / "sys", "ttyUSB").front()).empty());
}

TEST_CASE("a serial port is raw, at its speed, without handshakes, whatever a program before made of it",
          "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    const std::pair<int, speed_t> speeds[] = {{1200, B1200},     {2400, B2400},     {4800, B4800},
                                              {9600, B9600},     {19200, B19200},   {38400, B38400},
                                              {57600, B57600},   {115200, B115200}, {230400, B230400},
                                              {460800, B460800}, {921600, B921600}};
    for (const auto& [baud, speed] : speeds) {
        termios before{};
        REQUIRE(tcgetattr(terminal.master(), &before) == 0);
        before.c_iflag |= static_cast<tcflag_t>(ICRNL | IXON | ISTRIP);
        before.c_oflag |= static_cast<tcflag_t>(OPOST | ONLCR);
        before.c_lflag |= static_cast<tcflag_t>(ECHO | ICANON | ISIG);
        before.c_cflag |= static_cast<tcflag_t>(HUPCL | CSTOPB | CRTSCTS);
        before.c_cflag &= ~static_cast<tcflag_t>(CLOCAL);
        before.c_cc[VMIN] = 7;
        before.c_cc[VTIME] = 9;
        cfsetspeed(&before, baud == 9600 ? B1200 : B9600);
        REQUIRE(tcsetattr(terminal.master(), TCSANOW, &before) == 0);
        // What has come before it was opened belongs to nobody.
        REQUIRE(write(terminal.master(), "old", 3) == 3);
        std::vector<unsigned long> asked;
        answer_to_ioctl = [&](unsigned long request, void*) {
            asked.push_back(request);
            return std::optional<int>();
        };
        {
            SerialPort port(terminal.path(), clock, baud);
            termios now{};
            REQUIRE(tcgetattr(terminal.master(), &now) == 0);
            CAPTURE(baud);
            CHECK(cfgetospeed(&now) == speed);
            CHECK(cfgetispeed(&now) == speed);
            CHECK((now.c_iflag & static_cast<tcflag_t>(ICRNL | IXON | ISTRIP)) == 0);
            CHECK((now.c_oflag & static_cast<tcflag_t>(OPOST)) == 0);
            CHECK((now.c_lflag & static_cast<tcflag_t>(ECHO | ICANON | ISIG)) == 0);
            CHECK((now.c_cflag & static_cast<tcflag_t>(HUPCL | CSTOPB | CRTSCTS | PARENB)) == 0);
            CHECK((now.c_cflag & static_cast<tcflag_t>(CLOCAL | CREAD)) ==
                  static_cast<tcflag_t>(CLOCAL | CREAD));
            CHECK((now.c_cflag & CSIZE) == CS8);
            CHECK(now.c_cc[VMIN] == 0);
            CHECK(now.c_cc[VTIME] == 0);
            std::array<char, 8> bytes{};
            CHECK(port.read(bytes, SessionTime()) == 0);
            CHECK(std::ranges::count(asked, TIOCEXCL) == 1);
            CHECK(std::ranges::count(asked, TIOCNXCL) == 0);
        }
        CHECK(std::ranges::count(asked, TIOCNXCL) == 1);
        answer_to_ioctl = nullptr;
    }
    for (const int baud : {0, 1199, 1201, 9601, 921601})
        CHECK_THROWS_WITH(SerialPort(terminal.path(), clock, baud),
                          Contains(fmt::format("cannot be set to {} baud; name a usual speed", baud)));
    CHECK_NOTHROW(SerialPort(terminal.path(), clock, 921600)); // nothing of the refused ones holds it
}

TEST_CASE(
    "a parallel port is claimed for this program alone, pointed outward, and each refusal has its remedy",
    "[unit]") {
    const TemporaryFolder folder;
    const std::string path = folder.file("parport0", "").string();
    std::vector<std::string> asked;
    unsigned long refused = 0;
    int error = 0;
    answer_to_ioctl = [&](unsigned long request, void* argument) -> std::optional<int> {
        switch (request) {
        case PPEXCL:
            asked.emplace_back("exclusive");
            break;
        case PPCLAIM:
            asked.emplace_back("claim");
            break;
        case PPRELEASE:
            asked.emplace_back("release");
            break;
        case PPDATADIR:
            asked.push_back(fmt::format("direction {}", *static_cast<int*>(argument)));
            break;
        case PPWDATA:
            asked.push_back(fmt::format("write {}", *static_cast<unsigned char*>(argument)));
            break;
        default:
            return std::nullopt;
        }
        return request == refused ? -error : 0;
    };
    using Words = std::vector<std::string>;
    {
        ParallelTrigger trigger(path);
        CHECK(trigger.name() == "parallel port " + path);
        CHECK(trigger.needs_code());
        CHECK(trigger.fault().empty());
        CHECK(asked == Words{"exclusive", "claim", "direction 0", "write 0"});
        asked.clear();
        CHECK(trigger.send({SessionTime(), 0xA5, "onset"}));
        trigger.rest();
        CHECK(asked == Words{"write 165", "write 0"});
        refused = PPWDATA;
        error = ENXIO;
        CHECK_FALSE(trigger.send({SessionTime(), 1, ""}));
        CHECK(trigger.fault() == "No such device or address");
        refused = 0;
        asked.clear();
    }
    CHECK(asked == Words{"write 0", "release"});
    const auto refusal = [&](unsigned long request, int why) {
        refused = request;
        error = why;
        asked.clear();
        std::string said;
        try {
            ParallelTrigger trigger(path);
        } catch (const DeviceError& failure) {
            said = failure.what();
        }
        return said;
    };
    CHECK_THAT(refusal(PPEXCL, EBUSY),
               Contains("cannot be had: Device or resource busy; another program or the"));
    CHECK(asked == Words{"exclusive"});
    CHECK_THAT(refusal(PPCLAIM, EAGAIN), Contains("cannot be had") && Contains("sudo rmmod lp"));
    CHECK(asked == Words{"exclusive", "claim"});
    CHECK_THAT(refusal(PPDATADIR, EINVAL),
               Contains("cannot be written to: Invalid argument; name another port"));
    CHECK(asked == Words{"exclusive", "claim", "direction 0", "release"});
    CHECK_THAT(refusal(PPWDATA, EPERM), Contains("cannot be written to") && Contains("adduser $USER lp"));
    CHECK(asked == Words{"exclusive", "claim", "direction 0", "write 0", "release"});
    for (const int none : {ENOENT, ENODEV, ENXIO})
        CHECK_THAT(refusal(PPCLAIM, none), Contains("sudo modprobe ppdev"));
    CHECK_THAT(refusal(PPCLAIM, EACCES), Contains("adduser $USER lp"));
    answer_to_ioctl = nullptr;
    CHECK_THROWS_WITH(ParallelTrigger((folder.path() / "parport7").string()),
                      Contains("parport7 cannot be opened: No such file") && Contains("modprobe"));
}

TEST_CASE("the driver of a serial chip that refuses low latency, or has it, is asked no more", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    for (const bool has_it : {true, false}) {
        int asked = 0, set = 0;
        answer_to_ioctl = [&](unsigned long request, void* argument) -> std::optional<int> {
            if (request == TIOCGSERIAL) {
                ++asked;
                static_cast<serial_struct*>(argument)->flags =
                    has_it ? static_cast<int>(ASYNC_LOW_LATENCY) : 0;
                return has_it ? 0 : -ENOTTY;
            }
            if (request == TIOCSSERIAL) {
                ++set;
                return 0;
            }
            return std::nullopt;
        };
        const SerialPort port(terminal.path(), clock);
        CHECK(asked == 1);
        CHECK(set == 0);
    }
    answer_to_ioctl = nullptr;
}

TEST_CASE("why a port cannot be opened is said with what helps", "[unit]") {
    const SteadyClock clock;
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(SerialPort((folder.path() / "none").string(), clock),
                      Contains("No such file") && Contains("its USB cable plugged in"));
    CHECK_THROWS_WITH(SerialPort(folder.path().string(), clock),
                      Contains("cannot be opened: Is a directory; plug the device out and in"));
    // Another lock than ours on it.
    const Terminal terminal;
    const int other = open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(flock(other, LOCK_EX | LOCK_NB) == 0);
    CHECK_THROWS_WITH(SerialPort(terminal.path(), clock),
                      Contains("is in use: another program has the port open"));
    close(other);
    CHECK_NOTHROW(SerialPort(terminal.path(), clock));
    // Nothing that was opened stays so.
    const auto open_descriptors = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                             std::filesystem::directory_iterator());
    };
    const auto before = open_descriptors();
    { const SerialPort port(terminal.path(), clock); }
    CHECK_THROWS_AS(SerialPort(terminal.path(), clock, 7), DeviceError);
    CHECK(open_descriptors() == before);
}
