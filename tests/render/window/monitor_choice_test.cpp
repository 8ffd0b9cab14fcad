/// Which monitor the observer's window takes, and that it leaves the monitor's mode as it is.
#include "render/window/monitor_choice.h"

#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

MonitorInfo monitor_of(int number, const char* name, glm::ivec2 size_px, int refresh_hz) {
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
    CHECK(choose_monitor(desk_of_three, {.number = 1, .size_px = glm::ivec2(1920, 1080), .refresh_hz = 120.0})
              .number == 1);
    CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.number = 3, .size_px = glm::ivec2(1920, 1080)}),
                      Contains("HDMI-1") && Contains("does not show 1920 x 1080"));
    for (const int number : {-1, 0, 4})
        CHECK_THROWS_WITH(choose_monitor(desk_of_three, {.number = number}),
                          Contains("there is no monitor") && Contains("DP-2") && Contains("HDMI-1"));
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
    REQUIRE(before[0].refresh_hz == 60);
    REQUIRE(before[1].refresh_hz == 120);
    const int number = GENERATE(1, 2);
    const WindowContext window(
        {.size_px = {1920, 1080}, .title = "test", .fullscreen = true, .monitor = number});
    for (const MonitorInfo& now : list_monitors())
        CHECK(now.refresh_hz == before[static_cast<std::size_t>(now.number) - 1].refresh_hz);
    CHECK(window.monitor().number == number);
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
