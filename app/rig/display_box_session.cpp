#include "app/rig/display_box_session.h"

#include <cmath>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "devices/display_box/display_plus_plus_search.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/signal/t_lock.h"

namespace overt {
namespace {

DisplayPlusPlusSettings box_settings() {
    DisplayPlusPlusSettings settings;
    settings.record_folder = state_folder();
    return settings;
}

/// The protocol says how long a frame is lit in refreshes: at another rate the animation has another speed.
/// Both the crystals of a display and a box's measurement are good to better than a thousandth.
void require_rate(const std::string& port, double measured_hz, double wanted_hz) {
    if (std::abs(measured_hz - wanted_hz) <= 0.005 * wanted_hz)
        return;
    throw InputError(fmt::format("{}: the display box measures a video rate of {:.2f} Hz, the protocol says "
                                 "{} Hz: set the screen's mode, or correct [display] refresh_hz",
                                 port, measured_hz, wanted_hz));
}

/// Whether a box that has run on since the earlier readings can show this time.
bool follows_from(const std::vector<BoxClockPair>& earlier, const BoxClockPair& reading) {
    const MappedTime expected = BoxClockMap(earlier).to_session(reading.other);
    return reading.before - expected.uncertainty <= expected.time &&
           expected.time <= reading.after + expected.uncertainty;
}

/// A single answer may be lost on the way.
BoxClockPair read_clocks_patiently(DisplayPlusPlus& box) {
    for (int again = 2;; --again) {
        try {
            return box.read_clocks();
        } catch (const DeviceError&) {
            if (again == 0 || box.lost())
                throw;
        }
    }
}

} // namespace

BoxPlan plan_box(const DisplaySettings& display, bool in_window, bool virtual_time) {
    using Use = RecordedBox::Use;
    if (!has_t_lock(display.output))
        return {Use::no_mode, {}};
    if (!in_window || virtual_time)
        return {Use::simulated, {}};
    if (display.box == "none")
        return {Use::declined, {}};
    return {Use::box, display.box == "auto" ? std::nullopt : std::optional(display.box)};
}

BoxMode box_mode_of(OutputMode output) {
    const std::optional<BoxMode> mode = box_mode_called(name_of(output));
    OVERT_EXPECTS(mode);
    return *mode;
}

BoxIdentity require_box(const BoxPlan& plan) {
    SteadyClock clock;
    try {
        return find_display_plus_plus(serial_ports(), plan.port, serial_port_opener(clock), clock)
            ->identity();
    } catch (const DeviceError& error) {
        throw InputError(fmt::format(
            "this session needs its display box, which reads the 16-bit signal:\n{}\n"
            "Connect the box and see what `overt display status` finds; or write box = \"none\" in [display] "
            "if the display needs none; or take --virtual-time for a trial run without one",
            error.what()));
    }
}

void switch_back_what_was_left() {
    SteadyClock clock;
    try {
        if (const auto done =
                recover_display(serial_ports(), serial_port_opener(clock), clock, box_settings()))
            fmt::print(stderr, "{}\n", *done);
    } catch (const Error& error) {
        fmt::print(stderr, "warning: {}\n", error.what());
    }
}

DisplayBoxSession::DisplayBoxSession(const BoxIdentity& identity, const DisplaySettings& display,
                                     Clock& clock, PagePresenter& presenter)
    : clock_(clock), refresh_hz_(display.refresh_hz),
      box_(find_display_plus_plus({}, identity.port, serial_port_opener(clock), clock, box_settings())) {
    const BoxIdentity& now = box_->identity();
    if (now.serial_number != identity.serial_number)
        throw DeviceError(fmt::format("{}: the display box {} has become {} while the session was prepared; "
                                      "start again",
                                      now.port, identity.serial_number, now.serial_number));
    // A picture for it to lock to, in the mode that it is going to be in.
    presenter.show({});
    const BoxMode mode = box_mode_of(display.output);
    const ModeSwitch switched = box_->set_mode(mode);
    require_rate(now.port, switched.rate_hz, display.refresh_hz);
    box_->disable_temporal_dithering();
    box_->select_gamma_table(display.box_gamma_table);
    pairs_ = box_->relate_clocks([&] { return show_clock_reset(presenter); });
    recorded_ = {RecordedBox::Use::box,
                 now.port,
                 now.product,
                 now.serial_number,
                 now.firmware_date,
                 std::string(name_of(mode)),
                 display.box_gamma_table,
                 switched.settled_after,
                 switched.rate_hz};
}

ShownClockReset DisplayBoxSession::show_clock_reset(PagePresenter& presenter) {
    const SessionDuration refresh = from_seconds(1.0 / refresh_hz_);
    presenter.send_with_next_flip(t_lock::clock_reset_row, t_lock::clock_reset());
    const FlipReport shown = presenter.show({});
    // Where swaps do not wait for the screen, the line would be gone before it was scanned out.
    clock_.wait_until(shown.swapped + refresh / 2);
    const FlipReport next = presenter.show({});
    // The reset acts at the refresh after the line's last. The line was on screen not before its swap was
    // asked for, and was gone one refresh after the next swap had returned, however the driver queues them.
    return {shown.requested, next.vertical_blank + refresh};
}

void DisplayBoxSession::write_beginning(SessionStore& store) {
    store.display_box(recorded_);
    store.box_clock(pairs_);
    store.event({clock_.now(), -1, display_box_event, describe(recorded_)});
}

void DisplayBoxSession::read_clock(SessionStore& store) {
    const BoxClockPair reading = read_clocks_patiently(*box_);
    if (!follows_from(pairs_, reading))
        throw DeviceError(fmt::format("{}: the display box's clock shows {:.6f} s and did not run on since "
                                      "it was read last: the box was "
                                      "restarted or reset, and is not in {} mode any more",
                                      recorded_.port, to_seconds(reading.other), recorded_.mode));
    pairs_.push_back(reading);
    store.box_clock({reading});
}

void DisplayBoxSession::check(SessionStore& store) {
    try {
        read_clock(store);
    } catch (const DeviceError& error) {
        store.event({clock_.now(), -1, display_box_lost_event, error.what()});
        throw;
    }
}

void DisplayBoxSession::leave(SessionStore& store) {
    check(store);
    box_->restore_desktop();
    const BoxClockFit fit = fit_box_clock(pairs_);
    store.event({clock_.now(), -1, display_box_left_event,
                 fmt::format("back in Bits++; its clock by {} readings: drift {:.3f} ppm, at most {:.3f} ppm "
                             "off; times read off it at most {:.3f} ms off",
                             fit.readings, fit.drift_ppm, fit.drift_uncertainty_ppm,
                             1e3 * to_seconds(fit.uncertainty))});
}

} // namespace overt
