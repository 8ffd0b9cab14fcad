/// The curve of a planned study's power.
#pragma once

#include <filesystem>

#include "experiment/power/power_results.h"

namespace overt {

/// Draws power_curve.svg and power_curve.pdf: for each effect the share of studies that found it, with its
/// interval, by number of observers; the target and alpha as dashed lines. Throws RecordError.
void write_power_figure(const PowerResults& results, const std::filesystem::path& folder);

} // namespace overt
