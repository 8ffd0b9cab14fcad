#include "app/cli/own_folders.h"

#include <cstdlib>
#include <string>

namespace overt {

namespace {

namespace fs = std::filesystem;

fs::path own_folder(const char* own, const char* xdg, const fs::path& in_home, const std::string& temporary) {
    const auto variable = [](const char* name) -> fs::path {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (auto folder = variable(own); !folder.empty())
        return folder;
    if (const auto folder = variable(xdg); !folder.empty())
        return folder / "overt";
    if (const auto home = variable("HOME"); !home.empty())
        return home / in_home / "overt";
    return fs::temp_directory_path() / temporary;
}

} // namespace

fs::path cache_folder() { return own_folder("OVERT_CACHE", "XDG_CACHE_HOME", ".cache", "overt-cache"); }

fs::path state_folder() { return own_folder("OVERT_STATE", "XDG_STATE_HOME", ".local/state", "overt-state"); }

} // namespace overt
