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

/// Removes what write_whole_file() left hidden directly in a folder when its program was killed on this
/// machine. What a program that runs is writing stays, and so does what another machine has begun, whose
/// programs cannot be seen from here. A folder that is not there has nothing in it; what cannot be removed
/// stays. Gives how many files went.
int remove_abandoned_files(const std::filesystem::path& folder);

} // namespace overt
