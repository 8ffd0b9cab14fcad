/// A session's timing as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/record/read/timing_report.h"

namespace overt {

/// Writes a diagram, as SVG or PNG by the name's ending, with three panels: how many flips came how long
/// after the one before; where in each trial refreshes were missed, and why; how far each onset's time stamp
/// was from the line through all. Throws InputError for a name with another ending, RecordError if it cannot
/// be written.
void write_timing_plot(const TimingReport& report, const std::string& title,
                       const std::filesystem::path& file);

} // namespace overt
