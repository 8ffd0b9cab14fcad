/// What a screen's refreshes are found to be, and how a window's swaps behave, before a session trusts them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "render/vblank/display_surface.h"
#include "render/window/screen_output.h"
#include "render/window/window_system.h"

namespace overt {

/// The refreshes of some seconds in which every one got a picture.
struct RefreshMeasurement {
    VblankSource source = VblankSource::swap_return; ///< that stamped most of them
    int flips = 0;
    double mean_hz = 0.0;    ///< by a robust line through all stamps (RefreshFit); 0 of fewer than 3 flips
    double mean_se_hz = 0.0; ///< one standard error of it
    double interval_sd_ms = 0.0;      ///< of single intervals without a miss in them
    int outliers = 0;                 ///< stamps off the line
    int missed = 0;                   ///< refreshes without a picture of their own
    std::vector<double> intervals_ms; ///< from each flip to the next, in their order
};

/// Flips in their order. Where their source counts no refreshes, the count is inferred from the median
/// interval.
RefreshMeasurement summarise_refreshes(std::span<const FlipReport> flips);

/// How swaps behave one right after the other, without waiting for any.
struct SwapBehaviour {
    bool wait = false; ///< sooner or later one waits for the display
    int at_once = 0;   ///< so many returned before: 1 of two buffers, more where pictures are queued
};

/// `swap_s`: how long each took, `interval_s`: of a refresh.
SwapBehaviour judge_swaps(std::span<const double> swap_s, double interval_s);

/// All that is known of when pictures of a window are lit.
struct TimingFacts {
    RefreshMeasurement measured;
    SwapBehaviour swaps;
    bool blanks_are_real = false;             ///< stamps_stand_still() of the source
    std::vector<std::string> refused_sources; ///< better ones, and why not
    ScreenOutput output;
    WindowSystem system;
    std::optional<SwapModes> swap_modes; ///< of the pictures shown meanwhile; nothing: no server tells it
    bool is_software = false;            ///< no graphics card draws
};

/// Shows a dark screen for that long and watches its refreshes. `progress`: seconds done, and in all. Main
/// thread; the window's clock must go by itself.
TimingFacts measure_timing(WindowContext& window, WindowDisplay& display, Clock& clock, double seconds,
                           const std::function<void(int done, int total)>& progress);

} // namespace overt
