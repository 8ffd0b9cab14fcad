/// From a file of display faults (TOML), for rehearsals, to DisplayFaults. The format is described in
/// docs/presentation_timing.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiment/base/diagnostics.h"
#include "experiment/timing/display_faults.h"

namespace overt {

/// Reads and checks a fault file. All findings go to `diagnostics` with their places; nothing if one of them
/// is an error. Throws nothing for bad input.
std::optional<DisplayFaults> read_fault_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The same from a text; `file` is only its name.
std::optional<DisplayFaults> read_fault_text(std::string_view text, const std::string& file,
                                             Diagnostics& diagnostics);

} // namespace overt
