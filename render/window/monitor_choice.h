/// Which of several monitors shows the stimuli: one rule for sessions, the doctor and the checks of a
/// display.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "render/window/window_context.h"

namespace overt {

/// Of a rate, within which a session runs: 120 Hz and 119.88 Hz are the same to it, 60 and 59.94, but not 100
/// and 99.
inline constexpr double largest_rate_deviation = 0.005;

/// Whether the monitor's rate is this one within a share of it. Where the window system names whole rates
/// only, within 1 Hz: 59.94 Hz may be 59 or 60.
bool has_rate(const MonitorInfo& monitor, double refresh_hz, double tolerance = largest_rate_deviation);

struct MonitorWish {
    /// This one, if it has the size: by its number in list_monitors(), from 1, or by the name of its output
    /// or of its EDID. Empty: by its size, then by its rate.
    std::string which = {};
    std::optional<glm::ivec2> size_px = {}; ///< that its mode must have now
    /// Tells monitors of one size apart: the one that has it within 0.05 % (59.94 and 60 Hz lie 0.1 % apart),
    /// or else within 0.5 %. Where the window system names whole rates only, within 1 Hz.
    std::optional<double> refresh_hz = {};
};

/// Throws InputError that lists the monitors if there is none as wished, or more than one: which of two equal
/// monitors the observer looks at is nothing to guess at.
const MonitorInfo& choose_monitor(std::span<const MonitorInfo> monitors, const MonitorWish& wish);

} // namespace overt
