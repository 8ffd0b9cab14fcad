/// Where notes are kept that outlive a run.
#pragma once

#include <filesystem>

namespace overt {

/// $OVERT_STATE, else $XDG_STATE_HOME/overt, else ~/.local/state/overt, else a folder under the system's
/// temporary one. Not created.
std::filesystem::path state_folder();

} // namespace overt
