/// Where the program keeps what outlives a run. Neither folder is created here.
#pragma once

#include <filesystem>

namespace overt {

/// Of frames, maps and objects: $OVERT_CACHE, else $XDG_CACHE_HOME/overt, else ~/.cache/overt, else a
/// folder under the system's temporary one.
std::filesystem::path cache_folder();

/// Of notes: $OVERT_STATE, else $XDG_STATE_HOME/overt, else ~/.local/state/overt, else a folder under the
/// system's temporary one.
std::filesystem::path state_folder();

} // namespace overt
