/// Which of several monitors shows the stimuli: one rule for sessions, the doctor and the checks of a
/// display.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "render/window/window_context.h"

namespace overt {

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
