/// Where frames, maps and sculptures are kept between sessions.
#pragma once

#include <filesystem>

namespace overt {

/// $OVERT_CACHE, else $XDG_CACHE_HOME/overt, else ~/.cache/overt, else a folder under the system's temporary
/// one. Not created.
std::filesystem::path cache_folder();

} // namespace overt
