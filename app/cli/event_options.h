/// Options of commands that find fixations, saccades and blinks anew.
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

#include "experiment/events/event_thresholds.h"

namespace overt {

/// What the command line says of finding them.
struct EventOptions {
    bool detects = false; ///< --detect-events
    ChosenThresholds thresholds;

    std::optional<ChosenThresholds> detection() const {
        return detects ? std::optional(thresholds) : std::nullopt;
    }
};

/// --detect-events, which does what `what` says, and an option for each threshold, which needs it.
void add_event_options(CLI::App& command, EventOptions& options, const std::string& what);

/// An option for each threshold alone.
void add_threshold_options(CLI::App& command, ChosenThresholds& thresholds);

} // namespace overt
