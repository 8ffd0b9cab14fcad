#include "app/cli/cache_folder.h"

#include <cstdlib>

namespace overt {

std::filesystem::path cache_folder() {
    const auto variable = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (auto own = variable("OVERT_CACHE"); !own.empty())
        return own;
    if (const auto xdg = variable("XDG_CACHE_HOME"); !xdg.empty())
        return xdg / "overt";
    if (const auto home = variable("HOME"); !home.empty())
        return home / ".cache" / "overt";
    return std::filesystem::temp_directory_path() / "overt-cache";
}

} // namespace overt
