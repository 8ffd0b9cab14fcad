#include "experiment/base/path_inside.h"

#include <filesystem>

namespace overt {

bool stays_inside(std::string_view name) {
    if (name.empty() || name.find('\0') != std::string_view::npos)
        return false;
    const std::filesystem::path path(name);
    return path.is_relative() && *path.lexically_normal().begin() != "..";
}

bool is_plain_name(std::string_view name) {
    return stays_inside(name) && name.find('/') == std::string_view::npos && name != ".";
}

} // namespace overt
