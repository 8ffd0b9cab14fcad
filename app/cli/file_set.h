/// Text files that belong together, written so that none is ever seen half-written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace overt {

struct TextFile {
    std::filesystem::path path;
    std::string text;
};

/// Throws InputError if one of them is there already, unless `force`, or if its folder is not.
void check_can_write(const std::vector<TextFile>& files, bool force);

/// Brings all of them to the disk under hidden names, and only then gives them their names, in the order
/// given: the last is the one that makes the set valid. Throws InputError as check_can_write does, and
/// RecordError, leaving nothing new, if the disk refuses.
void write_file_set(const std::vector<TextFile>& files, bool force);

} // namespace overt
