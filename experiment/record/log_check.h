/// Looks through a write-ahead log (SQLite file format, section 4) as SQLite itself does, but tells of damage
/// where SQLite takes a frame that does not fit for the log's end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace overt {

/// A sentence about the first byte that cannot be right; nothing for a log that is whole, empty or not there.
/// A last frame that is cut short is no damage: the program was killed while writing it. That a frame of full
/// length fits needs a writer that empties its log whenever it begins it anew, as RowWriter does. Throws
/// RecordError if it cannot be read.
std::optional<std::string> log_damage(const std::filesystem::path& log);

} // namespace overt
