/// The window of the operator's view.
#pragma once

#include <filesystem>

namespace overt {

/// Until it is closed or asked to end; a session that ends stays shown. `times`: a table of the points of
/// gaze that were shown, with the tracker's time and the steady clock's when they stood in the window,
/// written at the end; empty: none. Gives the exit code. Throws InputError if nobody serves the socket, and
/// GraphicsError if there can be no window.
int watch_in_window(const std::filesystem::path& socket, const std::filesystem::path& times);

} // namespace overt
