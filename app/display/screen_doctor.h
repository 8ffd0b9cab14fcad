/// `overt doctor --window`: what a screen's refreshes are, measured.
#pragma once

#include <optional>

#include "app/display/display_commands.h"
#include "app/rig/input_latency.h"
#include "render/gl/gl_context.h"
#include "render/vblank/refresh_measurement.h"
#include "render/window/screen_check.h"
#include "render/window/window_context.h"

namespace overt {

/// What a window on a monitor was found to be like.
struct ExaminedScreen {
    MonitorInfo monitor;
    GlDescription graphics;
    TimingFacts facts;
    ScreenFacts signal; ///< of a window in 8 bits
    std::vector<ScreenFinding> findings;
    std::optional<InputLatency> inputs; ///< nothing: keys cannot be sent to this window

    bool is_refused() const;
};

/// Shows a dark screen for a while, and once more as long as keys are sent to it, at most input_s. Throws
/// GraphicsError if no window can be opened.
ExaminedScreen measure_screen(const DoctorOptions& options);

/// The same, and prints what was found; 1 if something would refuse a session.
int run_screen_doctor(const DoctorOptions& options);

/// "good", "risk" or "refused".
std::string_view name_of(ScreenFinding::Weight weight);

/// The monitor that was asked for, or the only one. Throws InputError if there is none of that number, or
/// none was named where there are several.
MonitorInfo chosen_monitor(const DoctorOptions& options);

} // namespace overt
