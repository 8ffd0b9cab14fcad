/// `overt doctor --window`: what a screen's refreshes are, measured.
#pragma once

#include "app/display/display_commands.h"
#include "render/window/window_context.h"

namespace overt {

/// Shows a dark screen for a while and prints what was found; 1 if something would refuse a session. Throws
/// GraphicsError if no window can be opened.
int run_screen_doctor(const DoctorOptions& options);

/// The monitor that was asked for, or the only one. Throws InputError if there is none of that number, or
/// none was named where there are several.
MonitorInfo chosen_monitor(const DoctorOptions& options);

} // namespace overt
