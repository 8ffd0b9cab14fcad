/// Looks through a write-ahead log (SQLite file format, section 4) as SQLite itself does, but tells of damage
/// where SQLite takes a frame that does not fit for the log's end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace overt {

struct LogFinding {
    enum class Kind : std::uint8_t {
        cut_off, ///< its end was never wholly written: the program was killed, or the power failed
        damaged  ///< what was written, and counted, is not there any more
    };
    Kind kind = Kind::damaged;
    std::string what; ///< a sentence with the frame and its bytes
};

/// What the first frame that does not fit says; nothing for a log that is whole, empty or not there.
///
/// A kill leaves a last frame that is cut short. A failure of power may leave zeros where the last frames
/// were to be, or frames of a transaction whose last one, the commit, is missing: of these nothing counted.
/// Any other frame that does not fit is damage. That a frame of an earlier use of the log's space does not
/// count as one needs a writer that empties its log whenever it begins it anew, as RowWriter does. Throws
/// RecordError if the log cannot be read.
std::optional<LogFinding> look_through_log(const std::filesystem::path& log);

} // namespace overt
