/// What the pointer's driver asks of X, and what it makes of the answers: an X server of the test's own takes
/// the library's place while there is one, for this program.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <cstring>

#include "devices/pointer/pointer_driver.h"
#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "tests/support/counted_clock.h"
#include "tests/support/kept_items.h"
#include "tests/support/next_function.h"

// Last: it defines words.
#include <X11/Xlib.h>

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct PointerStandIn {
    PointerStandIn() { now = this; }
    ~PointerStandIn() { now = nullptr; }
    PointerStandIn(const PointerStandIn&) = delete;
    PointerStandIn& operator=(const PointerStandIn&) = delete;

    bool is_there = true;
    int x = 0, y = 0, opened = 0, closed = 0, asked = 0;
    unsigned buttons = 0;
    bool was_asked_rightly = true;
    static inline PointerStandIn* now = nullptr;
};

constexpr Window root_of_stand_in = 77;

Display* standing_display() { return reinterpret_cast<Display*>(PointerStandIn::now); }

} // namespace

// They take the place of the library's for this program.
extern "C" {
Display* XOpenDisplay(const char* name) {
    if (!PointerStandIn::now)
        return next_function<decltype(XOpenDisplay)>("XOpenDisplay")(name);
    PointerStandIn::now->was_asked_rightly &= name == nullptr;
    PointerStandIn::now->opened += PointerStandIn::now->is_there;
    return PointerStandIn::now->is_there ? standing_display() : nullptr;
}
int XCloseDisplay(Display* display) {
    if (!PointerStandIn::now)
        return next_function<decltype(XCloseDisplay)>("XCloseDisplay")(display);
    PointerStandIn::now->was_asked_rightly &= display == standing_display();
    ++PointerStandIn::now->closed;
    return 0;
}
Window XDefaultRootWindow(Display* display) {
    if (!PointerStandIn::now)
        return next_function<decltype(XDefaultRootWindow)>("XDefaultRootWindow")(display);
    return root_of_stand_in;
}
Bool XQueryPointer(Display* display, Window window, Window* root, Window* child, int* x, int* y, int* x_in,
                   int* y_in, unsigned* state) {
    if (!PointerStandIn::now)
        return next_function<decltype(XQueryPointer)>("XQueryPointer")(display, window, root, child, x, y,
                                                                       x_in, y_in, state);
    PointerStandIn& server = *PointerStandIn::now;
    server.was_asked_rightly &= display == standing_display() && window == root_of_stand_in;
    ++server.asked;
    *root = window;
    *child = 0;
    *x = server.x;
    *y = server.y;
    *x_in = server.x + 1000; // of a window
    *y_in = server.y + 1000;
    *state = server.buttons;
    return 1;
}
}

TEST_CASE("the pointer is asked for at multiples of its interval, and a sample is where it was then",
          "[unit]") {
    PointerStandIn server;
    CountedClock clock;
    {
        PointerDriver driver(clock);
        const TrackerDescription described =
            driver.connect({.rate_hz = 250.0, .eye = Eye::left, .screen = {}});
        CHECK(described.name == "mouse");
        CHECK(described.sample_rate_hz == 250.0);
        CHECK(described.eye == Eye::left);
        CHECK_FALSE(described.both_eyes);
        CHECK(described.model == "pointer of the X server");
        CHECK(driver.calibrates_itself());
        clock.time = SessionTime(10s + 1ms);
        driver.start();
        KeptItems items;
        // Not before its time, and until the deadline at most.
        CHECK(driver.read(items, SessionTime(10s + 3ms)) == RecordingState::running);
        CHECK(clock.time == SessionTime(10s + 3ms));
        CHECK(server.asked == 0);
        CHECK(items.items.empty());
        server.x = 300;
        server.y = 200;
        CHECK(driver.read(items, SessionTime(10s + 4ms)) == RecordingState::running);
        CHECK(clock.time == SessionTime(10s + 4ms));
        REQUIRE(items.items.size() == 1);
        const auto first = std::get<GazeSample>(items.items[0]);
        CHECK(first.sampled_at == tracker_time(10'004'000));
        CHECK(first.eye == Eye::left);
        CHECK(first.gaze == ScreenPoint{300.5, 200.5});
        CHECK(first.pupil_area == 1.0f);
        CHECK(driver.read(items, SessionTime(11s)) == RecordingState::running);
        CHECK(clock.time == SessionTime(10s + 8ms));
        // What was slept through is not made up.
        clock.time = SessionTime(10s + 17ms);
        driver.read(items, SessionTime(11s));
        CHECK(clock.time == SessionTime(10s + 17ms));
        driver.read(items, SessionTime(11s));
        CHECK(clock.time == SessionTime(10s + 20ms));
        CHECK(items.items.size() == 4);
        CHECK(server.asked == 4);
        clock.reading = 1us;
        clock.time = SessionTime(5s);
        const auto clocks = driver.read_clocks();
        REQUIRE(clocks);
        CHECK(clocks->before == SessionTime(5s + 1us));
        CHECK(clocks->other == tracker_time(5'000'001));
        CHECK(clocks->after == SessionTime(5s + 2us));
        CHECK(server.opened == 1);
        CHECK(server.closed == 0);
        // Again after it was lost.
        CHECK(driver.connect({.rate_hz = 5000.0, .eye = Eye::right, .screen = {}}).sample_rate_hz == 1000.0);
        CHECK(server.opened == 2);
        CHECK(server.closed == 1);
        clock.reading = {};
        clock.time = SessionTime(20s);
        driver.start();
        driver.read(items, SessionTime(21s));
        CHECK(clock.time == SessionTime(20s + 1ms));
        CHECK(std::get<GazeSample>(items.items.back()).eye == Eye::right);
    }
    CHECK(server.closed == 2);
    CHECK(server.was_asked_rightly);
}

TEST_CASE("buttons of the pointer are told when they change, and the left one held is a closed eye",
          "[unit]") {
    PointerStandIn server;
    CountedClock clock;
    PointerDriver driver(clock);
    driver.connect({.rate_hz = 1000.0, .eye = Eye::right, .screen = {}});
    server.buttons = Button2Mask;
    driver.start();
    const auto read = [&](unsigned buttons) {
        server.buttons = buttons;
        KeptItems items;
        driver.read(items, SessionTime::max());
        std::string said;
        for (const auto& button : items.all<TrackerButton>()) {
            said += std::to_string(button.number) + (button.is_down ? " down " : " up ");
            CHECK(button.at == items.all<GazeSample>().at(0).sampled_at);
        }
        REQUIRE(items.all<GazeSample>().size() == 1);
        const GazeSample sample = items.all<GazeSample>()[0];
        CHECK(std::holds_alternative<GazeSample>(items.items.back()));
        CHECK(sample.gaze.has_value() == ((buttons & Button1Mask) == 0));
        CHECK(sample.pupil_area == ((buttons & Button1Mask) == 0 ? 1.0f : 0.0f));
        return said;
    };
    CHECK(read(0).empty());
    CHECK(read(ShiftMask | ControlMask | LockMask | Button4Mask | Button5Mask).empty());
    CHECK(read(Button1Mask) == "1 down ");
    CHECK(read(Button1Mask).empty());
    CHECK(read(Button1Mask | Button2Mask | Button3Mask) == "2 down 3 down ");
    CHECK(read(Button2Mask | ShiftMask) == "1 up 3 up ");
    driver.start(); // what is held from before is told again
    CHECK(read(Button2Mask) == "2 down ");
    CHECK(read(0) == "2 up ");
}

TEST_CASE("the row of the pointer says whether there is an X server, and its driver what is missing",
          "[unit]") {
    const TrackerDevice device = tracker_device_of<kind_called<TrackerKind>("mouse")>();
    const char* const here = std::getenv("DISPLAY");
    const std::string before = here ? here : "";
    setenv("DISPLAY", ":5", 1);
    CHECK(device.look_for() == "there is an X server");
    unsetenv("DISPLAY");
    CHECK(device.look_for() == "there is no X server (DISPLAY)");
    if (here)
        setenv("DISPLAY", before.c_str(), 1);
    PointerStandIn server;
    server.is_there = false;
    CountedClock clock;
    {
        PointerDriver driver(clock);
        CHECK_THROWS_AS(driver.connect({}), DeviceError);
    }
    CHECK(server.opened == 0);
    CHECK(server.closed == 0);
    CHECK(device.can_do == "1000 Hz of the pointer, in place of gaze");
}
