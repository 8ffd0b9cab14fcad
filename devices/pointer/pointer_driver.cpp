#include "devices/pointer/pointer_driver.h"

#include <algorithm>
#include <cstdlib>

#include <X11/Xlib.h>

#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr double fastest_hz = 1000.0;
constexpr unsigned known_buttons = 3;

} // namespace

struct PointerDriver::XConnection {
    Display* display = XOpenDisplay(nullptr);
    ~XConnection() {
        if (display)
            XCloseDisplay(display);
    }
};

PointerDriver::PointerDriver(Clock& clock) : clock_(clock) {}
PointerDriver::~PointerDriver() = default;

TrackerDescription PointerDriver::connect(const TrackerWish& wish) {
    x_ = std::make_unique<XConnection>();
    if (!x_->display)
        throw DeviceError(
            "the mouse pointer cannot be asked for: there is no X server (DISPLAY is not set, or "
            "cannot be reached)");
    const double rate_hz = std::min(wish.rate_hz, fastest_hz);
    interval_ns_ = static_cast<std::int64_t>(1e9 / rate_hz);
    eye_ = wish.eye;
    return {"mouse", rate_hz, wish.eye, false, "pointer of the X server"};
}

void PointerDriver::start() {
    next_ = clock_.now().time_since_epoch().count() / interval_ns_ + 1;
    buttons_ = 0;
}

RecordingState PointerDriver::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    // What was slept through is not made up: a sample is where the pointer was when it was asked for.
    const SessionTime due(std::chrono::nanoseconds(next_ * interval_ns_));
    if (due > deadline) {
        clock_.wait_until(deadline);
        return RecordingState::running;
    }
    clock_.wait_until(due);
    Window root{}, child{};
    int x{}, y{}, x_in{}, y_in{};
    unsigned state{};
    XQueryPointer(x_->display, XDefaultRootWindow(x_->display), &root, &child, &x, &y, &x_in, &y_in, &state);
    const SessionTime now = clock_.now();
    const TrackerTime at = tracker_time(now.time_since_epoch().count() / 1000);
    for (unsigned button = 1; button <= known_buttons; ++button) {
        const unsigned mask = Button1Mask << (button - 1);
        if ((state & mask) != (buttons_ & mask))
            sink.put(TrackerButton{at, static_cast<int>(button), (state & mask) != 0});
    }
    buttons_ = state;
    GazeSample sample;
    sample.sampled_at = at;
    sample.eye = eye_;
    if ((state & Button1Mask) == 0) {
        sample.gaze = ScreenPoint{x + 0.5, y + 0.5}; // the middle of the pixel
        sample.pupil_area = 1.0f;
    }
    sink.put(sample);
    next_ = std::max(next_ + 1, now.time_since_epoch().count() / interval_ns_ + 1);
    return RecordingState::running;
}

/// Its clock is the session's.
std::optional<ClockPair> PointerDriver::read_clocks() noexcept {
    const SessionTime before = clock_.now();
    return ClockPair{before, tracker_time(before.time_since_epoch().count() / 1000), clock_.now()};
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("mouse")>() {
    return {.make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
                return std::make_unique<PointerDriver>(parts.clock);
            },
            .can_do = "1000 Hz of the pointer, in place of gaze",
            .look_for =
                [] {
                    return std::string(std::getenv("DISPLAY") ? "there is an X server"
                                                              : "there is no X server (DISPLAY)");
                }};
}

} // namespace overt
