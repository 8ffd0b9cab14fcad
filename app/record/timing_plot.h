/// A session's timing as a picture.
#pragma once

#include <string>

#include "experiment/record/read/timing_report.h"

namespace overt {

/// An SVG document with three panels: how many flips came how long after the one before; where in each trial
/// refreshes were missed, and why; how far each onset's time stamp was from the line through all.
std::string timing_plot(const TimingReport& report, const std::string& title);

} // namespace overt
