#include "experiment/base/path_inside.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

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

std::string why_no_file_inside(const std::filesystem::path& folder, std::string_view name) {
    if (!stays_inside(name))
        return "leads out of the folder";
    std::filesystem::path place = folder;
    std::filesystem::file_type type = std::filesystem::file_type::not_found;
    for (const std::filesystem::path& part : std::filesystem::path(name).lexically_normal()) {
        place /= part;
        std::error_code error;
        type = std::filesystem::symlink_status(place, error).type();
        if (type == std::filesystem::file_type::symlink)
            return "is a link, or lies behind one, which is not followed";
        if (type == std::filesystem::file_type::not_found)
            return "is missing";
    }
    return type == std::filesystem::file_type::regular ? "" : "is no file";
}

std::filesystem::path require_file_inside(const std::filesystem::path& folder, std::string_view name) {
    const std::filesystem::path file = folder / name;
    if (const std::string why = why_no_file_inside(folder, name); !why.empty())
        throw RecordError(fmt::format("{}: {}. Nothing outside of a session's folder is read or copied.",
                                      file.string(), why));
    return file;
}

} // namespace overt
