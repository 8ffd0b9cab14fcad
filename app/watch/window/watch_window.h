/// The window of the operator's view.
#pragma once

#include <filesystem>

namespace overt {

/// Until it is closed; a session that ends stays shown. Gives the exit code. Throws InputError if nobody
/// serves the socket, and GraphicsError if there can be no window.
int watch_in_window(const std::filesystem::path& socket);

} // namespace overt
