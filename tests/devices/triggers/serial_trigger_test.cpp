#include "devices/triggers/serial_trigger.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "devices/triggers/marker_device.h"
#include "devices/triggers/parallel_trigger.h"
#include "devices/triggers/threaded_marker_sink.h"
#include "experiment/base/error.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

TEST_CASE("a serial trigger sends each code as a byte and a 0 after it", "[unit]") {
    SteadyClock clock;
    const Terminal terminal;
    auto output =
        std::make_unique<SerialTrigger>(std::make_unique<SerialPort>(terminal.path(), clock, 57600), clock);
    CHECK(output->name() == "serial port " + terminal.path());
    ThreadedMarkerSink sink(std::move(output), clock, {1ms, 1ms});
    for (const int code : {1, 13, 255, 17})
        sink.mark({clock.now(), static_cast<std::uint8_t>(code), "any"});
    CHECK(sink.finish().empty());
    std::string came;
    while (came.size() < 9) {
        char bytes[16];
        pollfd waiting{terminal.master(), POLLIN, 0};
        REQUIRE(poll(&waiting, 1, 20'000) == 1);
        const ssize_t count = read(terminal.master(), bytes, sizeof bytes);
        REQUIRE(count > 0);
        came.append(bytes, static_cast<std::size_t>(count));
    }
    CHECK(came == std::string("\0\1\0\15\0\377\0\21\0", 9));
}

TEST_CASE("markers as lines of text are codes in figures, or without codes the texts of all", "[unit]") {
    SteadyClock clock;
    const Terminal terminal;
    const bool sends_codes = GENERATE(true, false);
    ThreadedMarkerSink sink(std::make_unique<SerialText>(std::make_unique<SerialPort>(terminal.path(), clock),
                                                         clock, sends_codes),
                            clock, {0ms, 0ms});
    sink.mark({clock.now(), 17, "ONSET runner"});
    sink.mark({clock.now(), 0, "FRAME 1"});
    sink.mark({clock.now(), 255, ""});
    CHECK(sink.finish().empty());
    const std::string wanted = sends_codes ? "17\n255\n" : "ONSET runner\nFRAME 1\n255\n";
    std::string came;
    while (came.size() < wanted.size()) {
        char bytes[64];
        pollfd waiting{terminal.master(), POLLIN, 0};
        REQUIRE(poll(&waiting, 1, 20'000) == 1);
        const ssize_t count = read(terminal.master(), bytes, sizeof bytes);
        REQUIRE(count > 0);
        came.append(bytes, static_cast<std::size_t>(count));
    }
    CHECK(came == wanted);
}

TEST_CASE("a serial trigger that is unplugged fails each marker with the reason", "[unit]") {
    SteadyClock clock;
    Terminal terminal;
    ThreadedMarkerSink sink(
        std::make_unique<SerialTrigger>(std::make_unique<SerialPort>(terminal.path(), clock), clock), clock);
    terminal.hang_up();
    sink.mark({clock.now(), 5, ""});
    const auto said = sink.finish();
    REQUIRE(said.size() == 1);
    CHECK_THAT(said.front(), Contains("1 marker could not be sent: "));
}

TEST_CASE("a serial port is not set to a speed that none has", "[unit]") {
    const SteadyClock clock;
    const Terminal terminal;
    CHECK_THROWS_WITH(SerialPort(terminal.path(), clock, 12345), Contains("12345 baud"));
    CHECK_NOTHROW(SerialPort(terminal.path(), clock, 9600));
}

TEST_CASE("a parallel port that is not there or is none is refused with a remedy", "[unit]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(ParallelTrigger((folder.path() / "parport9").string()),
                      Contains("parport9 cannot be opened") && Contains("modprobe ppdev"));
    CHECK_THROWS_WITH(ParallelTrigger(folder.file("parport0", "").string()), Contains("cannot be had"));
}

TEST_CASE("a row of markers opens what its settings name: codes, their figures, or texts", "[unit]") {
    SteadyClock clock;
    const std::string session = "s01";
    MarkerOutputSettings settings;
    const auto sent = [&](bool as_text, bool has_codes) {
        const Terminal terminal;
        settings.address = terminal.path();
        settings.as_text = as_text;
        settings.codes = has_codes ? std::vector<std::string>{"ONSET 17"} : std::vector<std::string>();
        const auto output =
            marker_device_of<kind_called<MarkerOutputKind>("serial")>().open({settings, clock, session});
        CHECK(output->name() == "serial port " + terminal.path() + (as_text ? ", lines of text" : ""));
        CHECK(output->needs_code() == (!as_text || has_codes));
        CHECK(output->send({clock.now(), 17, "ONSET runner"}));
        std::string came;
        pollfd waiting{terminal.master(), POLLIN, 0};
        while (poll(&waiting, 1, came.empty() ? 20'000 : 50) == 1) {
            char bytes[64];
            const ssize_t count = read(terminal.master(), bytes, sizeof bytes);
            REQUIRE(count > 0);
            came.append(bytes, static_cast<std::size_t>(count));
        }
        return came;
    };
    CHECK(sent(false, true).back() == 17);
    CHECK(sent(true, true) == "17\n");
    CHECK(sent(true, false) == "ONSET runner\n");
    const auto parallel = [&](const std::string& address) {
        settings.address = address;
        return marker_device_of<kind_called<MarkerOutputKind>("parallel")>().open({settings, clock, session});
    };
    CHECK_THROWS_WITH(parallel("/dev/none"), Contains("The parallel port /dev/none cannot be opened"));
    if (!std::filesystem::exists("/dev/parport0"))
        CHECK_THROWS_WITH(parallel(""), Contains("The parallel port /dev/parport0 cannot be opened"));
}
