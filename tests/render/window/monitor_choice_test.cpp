/// Which monitor the observer's window takes, and that it leaves the monitor's mode as it is.
#include "render/window/monitor_choice.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/output_properties.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

MonitorInfo monitor_of(int number, const char* name, glm::ivec2 size_px, double refresh_hz) {
    MonitorInfo monitor;
    monitor.number = number;
    monitor.name = name;
    monitor.size_px = size_px;
    monitor.refresh_hz = refresh_hz;
    return monitor;
}

const std::vector<MonitorInfo> desk_of_three = {monitor_of(1, "DP-1", {1920, 1080}, 60),
                                                monitor_of(2, "DP-2", {1920, 1080}, 120),
                                                monitor_of(3, "HDMI-1", {2560, 1440}, 60)};

} // namespace

TEST_CASE("the stimulus monitor is told by its size, then by its rate", "[unit]") {
    CHECK(choose_monitor(desk_of_three, {.size_px = glm::ivec2(2560, 1440), .refresh_hz = 120.0}).number ==
          3);
    CHECK(choose_monitor(desk_of_three, {.size_px = glm::ivec2(1920, 1080), .refresh_hz = 120.0}).number ==
          2);
    CHECK(choose_monitor(desk_of_three, {.size_px = glm::ivec2(1920, 1080), .refresh_hz = 119.88}).number ==
          2);
    CHECK(choose_monitor(desk_of_three, {.size_px = glm::ivec2(1920, 1080), .refresh_hz = 59.94}).number ==
          1);
    CHECK(choose_monitor({desk_of_three.data(), 1}, {}).number == 1);
}

TEST_CASE("a monitor named by its number is taken if it has the size", "[unit]") {
    CHECK(
        choose_monitor(desk_of_three, {.which = "1", .size_px = glm::ivec2(1920, 1080), .refresh_hz = 120.0})
            .number == 1);
    CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.which = "3", .size_px = glm::ivec2(1920, 1080)}),
                      Contains("HDMI-1") && Contains("does not show 1920 x 1080"));
    for (const char* which : {"-1", "0", "4", "DP-3", "DP-"})
        CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.which = which}),
                          Contains("there is no monitor") && Contains("DP-2") && Contains("HDMI-1"));
}

TEST_CASE("a monitor is named by its output or its EDID, by which it must be the only one", "[unit]") {
    std::vector<MonitorInfo> desk = desk_of_three;
    desk[0].edid_name = "Display++";
    desk[2].edid_name = "U2720Q";
    CHECK(choose_monitor(desk, {.which = "DP-2"}).number == 2);
    CHECK(choose_monitor(desk, {.which = "Display++", .refresh_hz = 120.0}).number == 1);
    CHECK_THROWS_WITH(choose_monitor(desk, {.which = "U2720Q", .size_px = glm::ivec2(1920, 1080)}),
                      Contains("monitor 3 (HDMI-1, U2720Q, 2560 x 1440 px at 60 Hz) does not show"));
    desk[1].edid_name = "Display++";
    CHECK_THROWS_WITH(choose_monitor(desk, {.which = "Display++"}),
                      Contains("several monitors are called \"Display++\"") && Contains("DP-2"));
}

TEST_CASE("exact rates tell 59.94 from 60 Hz", "[unit]") {
    std::vector<MonitorInfo> desk = desk_of_three;
    desk[0].refresh_hz = 60.0;
    desk[1].refresh_hz = 60.0 / 1.001;
    desk[0].rate_is_exact = desk[1].rate_is_exact = true;
    const auto number_at = [&](double refresh_hz) {
        return choose_monitor(desk, {.size_px = glm::ivec2(1920, 1080), .refresh_hz = refresh_hz}).number;
    };
    CHECK(number_at(60.0) == 1);
    CHECK(number_at(59.94) == 2);
    // Both are as near as a session runs at, and neither is it.
    CHECK_THROWS_AS(number_at(60.1), InputError);
    desk[0].refresh_hz = 60.5;
    CHECK(number_at(60.0) == 2);
    CHECK_THROWS_AS(number_at(61.0), InputError);
}

TEST_CASE("where several monitors could be the observer's, they are listed and none is taken", "[unit]") {
    CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.size_px = glm::ivec2(1920, 1080)}),
                      Contains("2 monitors could be") && Contains("--monitor") && Contains("DP-1"));
    CHECK_THROWS_AS(choose_monitor(desk_of_three, {.size_px = glm::ivec2(1920, 1080), .refresh_hz = 144.0}),
                    InputError);
    CHECK_THROWS_AS(choose_monitor(desk_of_three, {}), InputError);
    CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.size_px = glm::ivec2(800, 600)}),
                      Contains("no monitor shows 800 x 600"));
    CHECK_THROWS_WITH(choose_monitor({}, {}), Contains("no monitor"));
}

TEST_CASE("a window on a whole screen leaves the monitor's rate as it was set", "[gl]") {
    const auto desk = test::TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("no Xorg with the dummy driver (packages.txt), or it may not be started here");
    const std::vector<MonitorInfo> before = list_monitors();
    REQUIRE(before.size() == 2);
    // By the clocks and totals of their modes, see TwoMonitors.
    REQUIRE(before[0].refresh_hz == Approx(138.50e6 / (2080 * 1111)));
    REQUIRE(before[1].refresh_hz == Approx(285.50e6 / (2080 * 1144)));
    REQUIRE((before[0].rate_is_exact && before[1].rate_is_exact));
    const int number = GENERATE(1, 2);
    const WindowContext window(
        {.size_px = {1920, 1080}, .title = "test", .fullscreen = true, .monitor = std::to_string(number)});
    for (const MonitorInfo& now : list_monitors())
        CHECK(now.refresh_hz == before[static_cast<std::size_t>(now.number) - 1].refresh_hz);
    CHECK(window.monitor().number == number);
}

TEST_CASE("a monitor's own name is read from its EDID, and finds it", "[gl]") {
    const auto desk = test::TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("no Xorg with the dummy driver (packages.txt), or it may not be started here");
    std::vector<std::uint8_t> edid(128);
    std::ranges::fill(edid.begin() + 1, edid.begin() + 7, std::uint8_t{0xff});
    // The third of four descriptors: tag 0xfc, the name, a line feed, blanks.
    const std::string_view descriptor("\0\0\0\xfc\0Display++\n   ", 18);
    std::ranges::copy(descriptor, edid.begin() + 54 + 2 * 18);
    test::OutputProperties("DUMMY1").put_bytes("EDID", edid);
    CHECK(list_monitors()[0].edid_name.empty());
    CHECK(list_monitors()[1].edid_name == "Display++");
    const WindowContext window(
        {.size_px = {1920, 1080}, .title = "test", .fullscreen = true, .monitor = "Display++"});
    CHECK(window.monitor().number == 2);
}

TEST_CASE("of two monitors of one size a window takes the one with its rate, and asks where both have it",
          "[gl]") {
    const auto desk = test::TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("no Xorg with the dummy driver (packages.txt), or it may not be started here");
    const WindowRequest at_120{
        .size_px = {1920, 1080}, .title = "test", .fullscreen = true, .refresh_hz = 120.0};
    CHECK(WindowContext(at_120).monitor().number == 2);
    REQUIRE(test::TwoMonitors::xrandr("--output DUMMY0 --mode fast"));
    CHECK_THROWS_WITH(WindowContext(at_120),
                      Contains("2 monitors could be") && Contains("DUMMY0") && Contains("DUMMY1"));
}
