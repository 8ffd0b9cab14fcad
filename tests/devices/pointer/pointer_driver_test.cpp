/// The pointer as a tracker, on an X server of the test's own.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <thread>

#include "devices/host/clocks.h"
#include "devices/pointer/pointer_driver.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include <X11/Xlib.h>

using namespace overt;
using namespace std::chrono_literals;

TEST_CASE("samples of the pointer are where it was put, at the wished rate", "[gl]") {
    const auto screen = test::VirtualScreen::start(800, 600, 24);
    SteadyClock clock;
    ThreadedTracker tracker(std::make_unique<PointerDriver>(clock), clock,
                            {.rate_hz = 500.0, .eye = Eye::left, .screen = {}});
    CHECK(tracker.description().sample_rate_hz == 500.0);
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    const auto put = [&](int x, int y) {
        XWarpPointer(display, 0, XDefaultRootWindow(display), 0, 0, 0, 0, x, y);
        XSync(display, 0);
    };
    put(100, 200);
    tracker.start_recording();
    std::this_thread::sleep_for(300ms);
    put(400, 50);
    std::this_thread::sleep_for(300ms);
    tracker.stop_recording();
    XCloseDisplay(display);
    std::vector<TrackerItem> items(2000);
    items.resize(tracker.poll(items));
    std::vector<GazeSample> samples;
    for (const TrackerItem& item : items)
        if (const auto* sample = std::get_if<GazeSample>(&item))
            samples.push_back(*sample);
    REQUIRE(samples.size() > 50);
    CHECK(samples.front().gaze == ScreenPoint{100.5, 200.5});
    CHECK(samples.back().gaze == ScreenPoint{400.5, 50.5});
    for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(samples[i].eye == Eye::left);
        CHECK((samples[i].gaze == ScreenPoint{100.5, 200.5} || samples[i].gaze == ScreenPoint{400.5, 50.5}));
        if (i > 0)
            CHECK(samples[i].sampled_at > samples[i - 1].sampled_at);
    }
}

TEST_CASE("without an X server there is no pointer", "[gl]") {
    const auto screen = test::VirtualScreen::start(100, 100, 24);
    const std::string here = std::getenv("DISPLAY");
    setenv("DISPLAY", ":9876", 1);
    SteadyClock clock;
    CHECK_THROWS_AS(PointerDriver(clock).connect({}), DeviceError);
    setenv("DISPLAY", here.c_str(), 1);
}
