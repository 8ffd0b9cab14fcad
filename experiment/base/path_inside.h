/// Whether a name from a file that somebody else may have written stays in the folder it is counted from.
#pragma once

#include <string_view>

namespace overt {

/// "maps/bust/pose_00.exr" stays inside; "", "/etc/passwd", "../x", "maps/../../x" and names with a zero byte
/// lead out. Links in the folder are not followed: who made the folder may have put its large files
/// elsewhere.
bool stays_inside(std::string_view name);

/// Whether a name can be one folder or file: it stays inside and has no separator. "bust", but not "a/b", "."
/// or "..".
bool is_plain_name(std::string_view name);

} // namespace overt
