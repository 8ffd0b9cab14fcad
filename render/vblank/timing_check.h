/// Whether pictures are lit when they should be: what was measured of a screen, weighed.
#pragma once

#include "render/vblank/refresh_measurement.h"
#include "render/window/monitor_choice.h"
#include "render/window/screen_check.h"

namespace overt {

/// Weighs the facts for a session that has to run at `nominal_hz`. `nominal_from` says whose rate that is:
/// "the protocol". One finding for each thing looked at.
std::vector<ScreenFinding> judge_timing(const TimingFacts& facts, double nominal_hz,
                                        std::string_view nominal_from);

/// What keeps the times of flips from being proven, a part of a sentence each; none: a real vertical blank
/// tells them, at the rate of the screen's own mode, and nothing copies or holds back pictures on their way.
/// A screen that names no rate of its mode is not doubted for that.
std::vector<std::string> doubts_about_times(const TimingFacts& facts);

/// The same findings for a session whose times are not claimed to be proven: what doubts_about_times() would
/// refuse is a risk.
std::vector<ScreenFinding> without_claim(std::vector<ScreenFinding> findings);

/// "119.982 Hz ± 0.001, intervals scatter by 0.02 ms, 0 of 600 stamps off the line, 0 refreshes missed".
std::string describe(const RefreshMeasurement& measured);

} // namespace overt
