/// From a file of faults of display and eye tracker (TOML), for trial runs, to SimulatedFaults. The format is
/// described in docs/presentation_timing.md and docs/trackers.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiment/base/diagnostics.h"
#include "experiment/ports/tracker_faults.h"
#include "experiment/timing/display_faults.h"

namespace overt {

/// What goes wrong in a trial run: with the display, and with the eye tracker.
struct SimulatedFaults : DisplayFaults {
    TrackerFaults tracker;
};

/// Reads and checks a fault file. All findings go to `diagnostics` with their places; nothing if one of them
/// is an error. Throws nothing for bad input.
std::optional<SimulatedFaults> read_fault_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The same from a text; `file` is only its name.
std::optional<SimulatedFaults> read_fault_text(std::string_view text, const std::string& file,
                                               Diagnostics& diagnostics);

} // namespace overt
