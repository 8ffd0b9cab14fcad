#include <catch2/catch.hpp>

#include <cstdlib>

#include "render/vblank/swap_watch.h"
#include "render/window/screen_output.h"
#include "render/window/window_context.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Shows so many pictures in the window as a driver does, through Present, over a connection of its own.
void present_pixmaps(const NativeWindow& window, glm::ivec2 size, int count) {
    xcb_connection_t* const link = xcb_connect(window.x11_server.c_str(), nullptr);
    std::free(xcb_present_query_version_reply(link, xcb_present_query_version(link, 1, 2), nullptr));
    const std::uint32_t pixmap = xcb_generate_id(link);
    xcb_create_pixmap(link, 24, pixmap, window.x11_window, static_cast<std::uint16_t>(size.x),
                      static_cast<std::uint16_t>(size.y));
    const std::uint32_t listener = xcb_generate_id(link);
    xcb_special_event_t* const events =
        xcb_register_for_special_xge(link, &xcb_present_id, listener, nullptr);
    xcb_present_select_input(link, listener, window.x11_window, XCB_PRESENT_EVENT_MASK_COMPLETE_NOTIFY);
    for (int i = 0; i < count; ++i) {
        xcb_present_pixmap(link, window.x11_window, pixmap, static_cast<std::uint32_t>(i + 1), XCB_NONE,
                           XCB_NONE, 0, 0, XCB_NONE, XCB_NONE, XCB_NONE, XCB_PRESENT_OPTION_NONE, 0, 0, 0, 0,
                           nullptr);
        xcb_flush(link);
        std::free(xcb_wait_for_special_event(link, events));
    }
    xcb_unregister_for_special_event(link, events);
    xcb_disconnect(link);
}

} // namespace

TEST_CASE("what Present copies into a window is counted as copied, once", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    WindowContext window({{160, 120}, "copies"});
    const auto watch = SwapWatch::of(window.native());
    REQUIRE(watch);
    CHECK(watch->take() == SwapModes{});
    present_pixmaps(window.native(), {160, 120}, 7);
    CHECK(watch->take() == SwapModes{.copied = 7});
    CHECK(watch->take() == SwapModes{});
    // Software shows its pictures by other means, and so none through Present.
    window.gl().Clear(GL_COLOR_BUFFER_BIT);
    window.swap_buffers();
    window.gl().Finish();
    CHECK(watch->take() == SwapModes{});
    CHECK(examine_output(window.native()).neighbours.empty());
}

TEST_CASE("without a window of X there is nothing to watch", "[unit]") { CHECK_FALSE(SwapWatch::of({})); }

TEST_CASE("an operator's monitor on the same X screen is seen, until it is switched off", "[gl]") {
    const auto desk = TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("there is no Xorg with a dummy card here");
    const auto neighbours_at = [](int monitor) {
        WindowContext window(
            {.size_px = {1920, 1080}, .fullscreen = true, .monitor = std::to_string(monitor)});
        return examine_output(window.native()).neighbours;
    };
    CHECK(neighbours_at(1) == std::vector<std::string>{"DUMMY1"});
    CHECK(neighbours_at(2) == std::vector<std::string>{"DUMMY0"});
    REQUIRE(TwoMonitors::xrandr("--output DUMMY1 --off"));
    CHECK(neighbours_at(1).empty());
}
