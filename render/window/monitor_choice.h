/// Which of several monitors shows the stimuli: one rule for sessions, the doctor and the checks of a
/// display.
#pragma once

#include <optional>
#include <span>

#include "render/window/window_context.h"

namespace overt {

struct MonitorWish {
    std::optional<int> number = {};         ///< in list_monitors(), from 1: this one, if it has the size
    std::optional<glm::ivec2> size_px = {}; ///< that its mode must have now
    /// Tells monitors of one size apart. Window systems name whole rates (60 for 59.94), so it is met within
    /// 1 Hz.
    std::optional<double> refresh_hz = {};
};

/// Throws InputError that lists the monitors if there is none as wished, or more than one: which of two equal
/// monitors the observer looks at is nothing to guess at.
const MonitorInfo& choose_monitor(std::span<const MonitorInfo> monitors, const MonitorWish& wish);

} // namespace overt
