/// `overt doctor --window`: what a screen's refreshes are, measured.
#pragma once

#include "app/display/display_commands.h"

namespace overt {

/// Shows a dark screen for a while and prints what was found; 1 if something would refuse a session. Throws
/// GraphicsError if no window can be opened.
int run_screen_doctor(const DoctorOptions& options);

} // namespace overt
