/// A file that is there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace overt {

/// Writes the bytes under a hidden name beside `path`, brings them to the disk, and only then gives them
/// their name; what stood there is replaced. From any thread, also for the same path at once. Throws
/// RecordError, leaving nothing new, if the disk refuses a single one of them.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

} // namespace overt
