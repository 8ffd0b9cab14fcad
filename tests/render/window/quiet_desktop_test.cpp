/// Screen savers that stay away while a window of a session lives, and the desktop that is asked for it.
#include "render/window/quiet_desktop.h"

#include <chrono>
#include <thread>

#include <catch2/catch.hpp>
#include <xcb/screensaver.h>

#include "render/window/window_context.h"
#include "render/window/xcb_reply.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Weight = ScreenFinding::Weight;

namespace {

/// Whether the server's own saver comes within some seconds; it is set to come after one.
bool saver_comes(xcb_connection_t* link) {
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(link)).data->root;
    xcb_set_screen_saver(link, 1, 1, XCB_BLANKING_PREFERRED, XCB_EXPOSURES_ALLOWED);
    xcb_force_screen_saver(link, XCB_SCREEN_SAVER_RESET);
    for (int tries = 0; tries < 60; ++tries) {
        std::this_thread::sleep_for(50ms);
        const auto info =
            owned(xcb_screensaver_query_info_reply(link, xcb_screensaver_query_info(link, root), nullptr));
        if (info && info->state == XCB_SCREENSAVER_STATE_ON)
            return true;
    }
    return false;
}

} // namespace

TEST_CASE("the server's screen saver does not come while a session's screen is kept, and comes after it",
          "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
    unsetenv("XDG_RUNTIME_DIR");
    WindowContext window({{160, 120}, "quiet"});
    const XcbLink link = link_to(nullptr);
    REQUIRE_FALSE(xcb_connection_has_error(link.get()));
    REQUIRE(saver_comes(link.get()));
    {
        const QuietDesktop quiet(window.native());
        REQUIRE(quiet.findings().size() == 1);
        CHECK(quiet.findings()[0].weight == Weight::good);
        CHECK(quiet.findings()[0].finding == "held back by the X server, with DPMS");
        CHECK_FALSE(saver_comes(link.get()));
    }
    CHECK(saver_comes(link.get()));
}

TEST_CASE("a window knows that another took its keyboard, and that it came back", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    WindowContext window({{160, 120}, "keyboard"});
    const XcbLink link = link_to(nullptr);
    const auto give_to = [&](std::uint32_t other) {
        const auto error =
            owned(xcb_request_check(link.get(), xcb_set_input_focus_checked(link.get(), XCB_INPUT_FOCUS_NONE,
                                                                            other, XCB_CURRENT_TIME)));
        REQUIRE_FALSE(error);
        window.poll_events();
    };
    window.poll_events();
    CHECK_FALSE(window.has_lost_focus());
    give_to(window.native().x11_window);
    CHECK_FALSE(window.has_lost_focus());
    give_to(XCB_INPUT_FOCUS_POINTER_ROOT);
    CHECK(window.has_lost_focus());
    give_to(window.native().x11_window);
    CHECK_FALSE(window.has_lost_focus());
}

TEST_CASE("where nothing can hold a screen saver back, that is a risk with its remedy", "[unit]") {
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
    unsetenv("XDG_RUNTIME_DIR");
    const QuietDesktop quiet({});
    REQUIRE(quiet.findings().size() == 1);
    CHECK(quiet.findings()[0].weight == Weight::risk);
    CHECK(quiet.findings()[0].finding.find("xset s off -dpms") != std::string::npos);
}
