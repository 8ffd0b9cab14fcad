/// What lies in a folder that somebody else may have made, and nothing else: names that lead out of it, links
/// and what is no file are never followed, read, copied or shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace overt {

/// "maps/bust/pose_00.exr" stays inside; "", "/etc/passwd", "../x", "maps/../../x" and names with a zero byte
/// lead out. By its letters alone: see require_file_inside() for what is on the disk.
bool stays_inside(std::string_view name);

/// Whether a name can be one folder or file: it stays inside and has no separator. "bust", but not "a/b", "."
/// or "..".
bool is_plain_name(std::string_view name);

/// Why `folder`/`name` is no file of the folder's own, as the end of a sentence that begins with its name:
/// "is missing", "is a link", "leads out of the folder", "is no file"; empty: it is one. The folder itself
/// may be reached by a link: whoever named it meant it. Opens nothing, so that a pipe cannot hold it up.
std::string why_no_file_inside(const std::filesystem::path& folder, std::string_view name);

inline bool is_file_inside(const std::filesystem::path& folder, std::string_view name) {
    return why_no_file_inside(folder, name).empty();
}

/// `folder`/`name`, once it is known to be a file of the folder's own. Throws RecordError that says why it is
/// none.
std::filesystem::path require_file_inside(const std::filesystem::path& folder, std::string_view name);

} // namespace overt
