#include "render/window/screen_check.h"

#include <cmath>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using Catch::Matchers::Contains;
using Weight = ScreenFinding::Weight;

namespace {

GammaRamp ramp(std::size_t entries, double exponent = 1.0) {
    std::vector<std::uint16_t> values;
    for (std::size_t i = 0; i < entries; ++i)
        values.push_back(static_cast<std::uint16_t>(std::lround(
            65535.0 * std::pow(static_cast<double>(i) / static_cast<double>(entries - 1), exponent))));
    return {values, values, values};
}

/// A Display++ as it should be.
ScreenFacts sound() {
    ScreenFacts facts;
    facts.system.is_x11 = true;
    facts.monitor.name = "DP-1";
    facts.monitor.size_px = facts.window_size = facts.framebuffer_px = {1920, 1080};
    facts.monitor.refresh_hz = 120;
    facts.gamma_ramp = ramp(256);
    facts.is_fullscreen = true;
    facts.signal = {{"max bpc", "8"}, {"Broadcast RGB", "Full"}};
    return facts;
}

/// What the protocol says of it.
DisplaySettings said() {
    DisplaySettings display;
    display.linearised_by = LinearisedBy::display;
    display.latency_ms = 8.1;
    return display;
}

Weight weight_of(const ScreenFacts& facts, const std::string& what, const DisplaySettings& display = said()) {
    for (const ScreenFinding& finding : judge_screen(facts, display))
        if (finding.what == what)
            return finding.weight;
    throw std::runtime_error("nobody looked at: " + what);
}

} // namespace

TEST_CASE("a screen as it should be gives no finding but good ones", "[unit]") {
    for (const ScreenFinding& finding : judge_screen(sound(), said())) {
        INFO(finding.what << ": " << finding.finding);
        CHECK(finding.weight == Weight::good);
    }
    CHECK_NOTHROW(refuse_unfit_screen(judge_screen(sound(), said())));
}

TEST_CASE("gamma tables are the identity in every form that drivers write it, and in no other", "[unit]") {
    for (const std::size_t entries : {256u, 1024u, 4096u}) {
        CAPTURE(entries);
        CHECK(is_identity(ramp(entries).red));
        std::vector<std::uint16_t> zero_filled;
        for (std::size_t i = 0; i < entries; ++i)
            zero_filled.push_back(static_cast<std::uint16_t>(i * 65536 / entries));
        CHECK(is_identity(zero_filled));
        CHECK_FALSE(is_identity(ramp(entries, 0.99).red));
        CHECK_FALSE(is_identity(ramp(entries, 1.01).red));
    }
    CHECK_FALSE(is_identity(std::vector<std::uint16_t>()));
    GammaRamp night = ramp(256);
    for (std::uint16_t& value : night.blue)
        value = static_cast<std::uint16_t>(value * 9 / 10);
    CHECK_THAT(describe(night), Contains("not the identity: of blue"));
    CHECK_FALSE(is_identity(night));
    CHECK(is_identity(ramp(256)));
    GammaRamp reckoned = ramp(256);
    reckoned.server_gamma.blue = 1.2;
    CHECK_FALSE(is_identity(reckoned));
    CHECK_THAT(describe(reckoned), Contains("1.2 (blue)"));
}

TEST_CASE("what changes a 16-bit signal for good is refused, and all of it at once", "[unit]") {
    ScreenFacts facts = sound();
    facts.gamma_ramp = ramp(256, 1.1);
    CHECK(weight_of(facts, "gamma table") == Weight::refusal);
    DisplaySettings native;
    native.output = OutputMode::native_8bit;
    CHECK(weight_of(facts, "gamma table", native) == Weight::risk);
    facts.gamma_ramp = {};
    facts.gamma_ramp.server_gamma.red = 1.5; // told even where the table is not
    CHECK(weight_of(facts, "gamma table") == Weight::refusal);
    facts.framebuffer_px = {2400, 1350};
    facts.monitor.refresh_hz = 60;
    CHECK(weight_of(facts, "scaling") == Weight::refusal);
    CHECK(weight_of(facts, "refresh rate") == Weight::refusal);
    CHECK_THROWS_WITH(refuse_unfit_screen(judge_screen(facts, said())),
                      Contains("gamma table") && Contains("scaling") && Contains("60 Hz"));
}

TEST_CASE("a screen of which nothing says what linearises it is refused, until it is said or measured",
          "[unit]") {
    DisplaySettings display;
    CHECK(weight_of(sound(), "linearisation", display) == Weight::refusal);
    CHECK_THROWS_WITH(refuse_unfit_screen(judge_screen(sound(), display)), Contains("linearised_by"));
    for (const LinearisedBy by : {LinearisedBy::display, LinearisedBy::box, LinearisedBy::none}) {
        display.linearised_by = by;
        CHECK(weight_of(sound(), "linearisation", display) == Weight::good);
    }
    display.linearised_by = LinearisedBy::unsaid;
    display.characterisation.emplace();
    CHECK(weight_of(sound(), "linearisation", display) == Weight::good);
}

TEST_CASE("a latency that was not measured is a risk", "[unit]") {
    DisplaySettings display = said();
    CHECK(weight_of(sound(), "latency", display) == Weight::good);
    display.latency_ms = 0.0;
    CHECK(weight_of(sound(), "latency", display) == Weight::risk);
}

TEST_CASE("a screen of another depth than the output sends is refused", "[unit]") {
    ScreenFacts facts = sound();
    DisplaySettings ten_bits;
    ten_bits.output = OutputMode::native_10bit;
    CHECK(weight_of(facts, "depth", ten_bits) == Weight::refusal);
    facts.bits_per_channel = 10;
    CHECK(weight_of(facts, "depth", ten_bits) == Weight::good);
    CHECK(weight_of(facts, "depth") == Weight::refusal);
}

TEST_CASE("what cannot be proved harmless is named as a risk and refuses nothing", "[unit]") {
    ScreenFacts facts = sound();
    facts.system.has_compositor = true;
    CHECK(weight_of(facts, "window system") == Weight::risk);
    facts.system.is_wayland = true;
    CHECK(weight_of(facts, "window system") == Weight::risk);
    facts.gamma_ramp = {};
    CHECK(weight_of(facts, "gamma table") == Weight::risk);
    facts.monitor.refresh_hz = 0;
    CHECK(weight_of(facts, "refresh rate") == Weight::risk);
    facts.is_fullscreen = false;
    facts.monitor.size_px = {2560, 1440};
    CHECK(weight_of(facts, "place") == Weight::risk);
    CHECK(weight_of(facts, "resolution") == Weight::risk);
    CHECK_NOTHROW(refuse_unfit_screen(judge_screen(facts, said())));
    facts.is_fullscreen = true;
    CHECK(weight_of(facts, "resolution") == Weight::refusal);
}

TEST_CASE("59.94 Hz is 60 Hz to a screen that counts whole hertz", "[unit]") {
    ScreenFacts facts = sound();
    DisplaySettings display;
    display.refresh_hz = 59.94;
    for (const int nominal : {59, 60}) {
        facts.monitor.refresh_hz = nominal;
        CHECK(weight_of(facts, "refresh rate", display) == Weight::good);
    }
    facts.monitor.refresh_hz = 75;
    CHECK(weight_of(facts, "refresh rate", display) == Weight::refusal);
    // An exact rate counts as exactly as the one that is measured before a session.
    facts.monitor.rate_is_exact = true;
    facts.monitor.refresh_hz = 60;
    CHECK(weight_of(facts, "refresh rate", display) == Weight::good);
    facts.monitor.refresh_hz = 59.5;
    CHECK(weight_of(facts, "refresh rate", display) == Weight::refusal);
    // What monitors call 144 Hz.
    facts.monitor.refresh_hz = 144.06;
    for (const double wished_hz : {144.0, 144.06}) {
        display.refresh_hz = wished_hz;
        CHECK(weight_of(facts, "refresh rate", display) == Weight::good);
    }
}

TEST_CASE("a window of eight bits on a screen of thirty is not taken for one of the screen's own", "[unit]") {
    ScreenFacts facts = sound();
    facts.system.depth = 24;
    CHECK(weight_of(facts, "depth") == Weight::good);
    facts.system.depth = 30;
    DisplaySettings display = said(); // a mode that packs bytes
    display.output = OutputMode::color_plus_plus;
    CHECK(weight_of(facts, "depth", display) == Weight::refusal);
    display.output = OutputMode::native_8bit;
    CHECK(weight_of(facts, "depth", display) == Weight::risk);
    display.output = OutputMode::native_10bit;
    facts.bits_per_channel = 10;
    CHECK(weight_of(facts, "depth", display) == Weight::good);
}

TEST_CASE("on a Wayland desktop without an X server it is said that windows need one", "[unit]") {
    const char* const desktop = std::getenv("WAYLAND_DISPLAY");
    const std::string before = desktop ? desktop : "";
    const char* const server = std::getenv("DISPLAY");
    const std::string x_before = server ? server : "";
    setenv("WAYLAND_DISPLAY", "wayland-0", 1);
    unsetenv("DISPLAY");
    CHECK_THROWS_WITH(list_monitors(),
                      Contains("windows need an X server") && Contains("log in to a session of X11"));
    desktop ? setenv("WAYLAND_DISPLAY", before.c_str(), 1) : unsetenv("WAYLAND_DISPLAY");
    if (server)
        setenv("DISPLAY", x_before.c_str(), 1);
}

TEST_CASE("the desktop's scale is advice under X11 and a resampling under Wayland", "[unit]") {
    ScreenFacts facts = sound();
    facts.monitor.content_scale = glm::vec2(1.25f);
    CHECK(weight_of(facts, "scaling") == Weight::good);
    facts.system.is_wayland = true;
    CHECK(weight_of(facts, "scaling") == Weight::refusal);
}

TEST_CASE("a window takes the monitor it is told to, and says what it stands on", "[gl]") {
    const auto screen = overt::test::VirtualScreen::start(640, 480, 24);
    unsetenv("WAYLAND_DISPLAY");
    CHECK(list_monitors().size() == 1);
    CHECK(list_monitors().front().size_px == glm::ivec2(640, 480));
    CHECK_THROWS_AS(WindowContext({{640, 480}, "test", true, true, 8, "2"}), InputError);
    CHECK_THROWS_WITH(WindowContext({{320, 240}, "test", true, true, 8, "1"}), Contains("640 x 480"));
    CHECK_THROWS_WITH(WindowContext({{320, 240}, "test", true}), Contains("640 x 480"));
    WindowContext window({{640, 480}, "test", true, true, 8, "1"});
    const ScreenFacts facts = facts_of(window);
    CHECK(facts.is_fullscreen);
    CHECK(facts.system.is_x11);
    CHECK_FALSE(facts.system.has_compositor);
    CHECK(facts.framebuffer_px == facts.window_size);
    CHECK(facts.monitor.number == 1);
}

// Last, because of its macros.
#include <X11/Xlib.h>

namespace {

/// Somebody else who moves and resizes the only window on the screen.
void put_window(int x, int y, unsigned width, unsigned height) {
    Display* const server = XOpenDisplay(nullptr);
    REQUIRE(server);
    Window root, parent, *children = nullptr;
    unsigned count = 0;
    XQueryTree(server, XDefaultRootWindow(server), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i)
        XMoveResizeWindow(server, children[i], x, y, width, height);
    XFree(children);
    XCloseDisplay(server);
}

} // namespace

TEST_CASE("a window that is resized while it is held still says so, and not before", "[gl]") {
    const auto screen = overt::test::VirtualScreen::start(640, 480, 24);
    unsetenv("WAYLAND_DISPLAY");
    WindowContext window({{320, 240}, "test"});
    put_window(10, 10, 320, 240);
    window.hold_still();
    const auto disturbed_within = [&](int seconds) {
        for (int i = 0; i < 200 * seconds && window.disturbance() == WindowDisturbance::none; ++i) {
            window.poll_events();
            usleep(5000);
        }
        return window.disturbance();
    };
    put_window(20, 30, 320, 240); // on the same screen
    CHECK(disturbed_within(1) == WindowDisturbance::none);
    put_window(20, 30, 300, 240);
    CHECK(disturbed_within(60) == WindowDisturbance::resized);
}
