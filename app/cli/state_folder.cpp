#include "app/cli/state_folder.h"

#include <cstdlib>

namespace overt {

std::filesystem::path state_folder() {
    const auto variable = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (auto own = variable("OVERT_STATE"); !own.empty())
        return own;
    if (const auto xdg = variable("XDG_STATE_HOME"); !xdg.empty())
        return xdg / "overt";
    if (const auto home = variable("HOME"); !home.empty())
        return home / ".local" / "state" / "overt";
    return std::filesystem::temp_directory_path() / "overt-state";
}

} // namespace overt
