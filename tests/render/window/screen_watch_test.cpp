/// A screen that changes under a window: mode, gamma table, compositor, monitors, and whether the window is
/// seen.
#include "render/window/screen_watch.h"

#include <cstdlib>
#include <string_view>

#include <catch2/catch.hpp>

#include "render/window/screen_check.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// Another program at the same X server.
class OtherClient {
  public:
    explicit OtherClient(const NativeWindow& window) : link_(link_to(window.x11_server.c_str())) {
        root_ = xcb_setup_roots_iterator(xcb_get_setup(link_.get())).data->root;
    }
    xcb_connection_t* link() { return link_.get(); }

    /// Until the server has done all that it was told.
    void sync() { owned(xcb_get_input_focus_reply(link(), xcb_get_input_focus(link()), nullptr)); }

    std::uint32_t add_window(int x, int y, int width, int height) {
        const std::uint32_t window = xcb_generate_id(link());
        const std::uint32_t unmanaged[] = {1};
        xcb_create_window(link(), XCB_COPY_FROM_PARENT, window, root_, static_cast<std::int16_t>(x),
                          static_cast<std::int16_t>(y), static_cast<std::uint16_t>(width),
                          static_cast<std::uint16_t>(height), 0, XCB_WINDOW_CLASS_INPUT_OUTPUT,
                          XCB_COPY_FROM_PARENT, XCB_CW_OVERRIDE_REDIRECT, unmanaged);
        return window;
    }
    /// As a compositor does when it starts; ends with this client.
    void composite() {
        const std::uint32_t owner = add_window(0, 0, 1, 1);
        constexpr std::string_view name = "picom";
        xcb_change_property(link(), XCB_PROP_MODE_REPLACE, owner, XCB_ATOM_WM_NAME, XCB_ATOM_STRING, 8,
                            static_cast<std::uint32_t>(name.size()), name.data());
        xcb_set_selection_owner(link(), owner, atom("_NET_WM_CM_S0"), XCB_CURRENT_TIME);
        sync();
    }

  private:
    xcb_atom_t atom(std::string_view name) {
        const auto reply = owned(xcb_intern_atom_reply(
            link(), xcb_intern_atom(link(), 0, static_cast<std::uint16_t>(name.size()), name.data()),
            nullptr));
        return reply->atom;
    }
    XcbLink link_;
    xcb_window_t root_ = 0;
};

std::string joined(const std::vector<std::string>& changes) {
    std::string all;
    for (const std::string& change : changes)
        all += change + "\n";
    return all;
}

} // namespace

TEST_CASE("without an X server nothing of the screen is seen to change", "[unit]") {
    CHECK(ScreenWatch({}).take_changes().empty());
}

TEST_CASE("a compositor that starts, and a window that is hidden or covered, are told once", "[gl]") {
    const auto screen = VirtualScreen::start(640, 480, 24);
    WindowContext window({{320, 240}, "watched"});
    window.poll_events();
    ScreenWatch watch(window.native());
    CHECK(joined(watch.take_changes()).empty());
    {
        OtherClient other(window.native());
        other.composite();
        CHECK_THAT(joined(watch.take_changes()), Contains("a compositor (picom) has taken the screen"));
        CHECK(watch.take_changes().empty());
    }
    OtherClient other(window.native());
    other.sync();
    // The server lets go of what a client had when it sees that it has gone.
    std::string gone;
    for (int i = 0; i < 1000 && gone.empty(); ++i)
        gone = joined(watch.take_changes());
    CHECK_THAT(gone, Contains("the compositor (picom) is gone"));

    xcb_unmap_window(other.link(), window.native().x11_window);
    other.sync();
    CHECK_THAT(joined(watch.take_changes()), Contains("the session's window is not shown"));
    xcb_map_window(other.link(), window.native().x11_window);
    other.sync();
    watch.take_changes();
    xcb_unmap_window(other.link(), window.native().x11_window);
    xcb_map_window(other.link(), window.native().x11_window);
    other.sync();
    CHECK_THAT(joined(watch.take_changes()), Contains("was hidden for a time, and is shown again"));
    CHECK(watch.take_changes().empty());

    xcb_map_window(other.link(), other.add_window(0, 0, 600, 400));
    other.sync();
    CHECK_THAT(joined(watch.take_changes()), Contains("another window lay over a part"));
}

TEST_CASE("another mode, gamma table or monitor is told once, and what was changed back too", "[gl]") {
    const auto desk = TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("there is no Xorg with a dummy card here");
    WindowContext window({.size_px = {1920, 1080}, .fullscreen = true, .monitor = "1"});
    window.poll_events();
    ScreenWatch watch(window.native());
    CHECK(joined(watch.take_changes()).empty());

    REQUIRE(TwoMonitors::xrandr("--output DUMMY0 --gamma 1.5:1:1"));
    CHECK_THAT(joined(watch.take_changes()), Contains("the gamma table is not the identity: of red"));
    CHECK(watch.take_changes().empty());

    // RandR's table stays as it is.
    REQUIRE(std::system("xgamma -ggamma 2 >/dev/null 2>&1") == 0);
    CHECK_THAT(joined(watch.take_changes()), Contains("a gamma of 1 (red), 2 (green) and 1 (blue)"));
    CHECK(watch.take_changes().empty());
    const ScreenFacts facts = facts_of(window);
    CHECK(facts.gamma_ramp.server_gamma.green == 2.0);
    CHECK_FALSE(is_identity(facts.gamma_ramp));

    REQUIRE(TwoMonitors::xrandr("--output DUMMY0 --mode fast"));
    const std::string faster = joined(watch.take_changes());
    CHECK_THAT(faster, !Contains("another window"));
    CHECK_THAT(faster, Contains("1920 x 1080 px at 119.98 Hz") &&
                           Contains("where it was 1920 x 1080 px at 59.93 Hz"));
    REQUIRE(TwoMonitors::xrandr("--output DUMMY0 --mode slow"));
    REQUIRE(TwoMonitors::xrandr("--output DUMMY0 --mode fast"));
    CHECK_THAT(joined(watch.take_changes()),
               Contains("mode was set meanwhile, and is 1920 x 1080 px at 119.98"));

    REQUIRE(TwoMonitors::xrandr("--output DUMMY1 --off"));
    CHECK_THAT(joined(watch.take_changes()), Contains("DUMMY1 shows no part of the same X screen any more"));
    REQUIRE(TwoMonitors::xrandr("--output DUMMY1 --mode slow --right-of DUMMY0"));
    CHECK_THAT(joined(watch.take_changes()), Contains("DUMMY1 shows another part of the same X screen now"));
}
