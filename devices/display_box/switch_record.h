/// A note on disk that a display box was switched away from its everyday mode. It outlives a crash, so that
/// the next start can switch the box back: in Color++ a desktop is not to be read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace overt {

/// Which box was switched to what.
struct SwitchRecord {
    std::string port;          ///< where it was
    std::string serial_number; ///< by which it is known again on another port; may be empty
    std::string mode;          ///< the name of the mode, for messages
    bool kept = false;         ///< the user wanted it so: it is switched back only on request
    bool operator==(const SwitchRecord&) const = default;
};

/// Writes the note into the folder, which is made if need be; in place of one that is there. It is on disk
/// when this returns. Throws RecordError.
void write_switch_record(const std::filesystem::path& folder, const SwitchRecord& record);

/// The note that lies in the folder; nothing if there is none. Throws RecordError if it cannot be read.
std::optional<SwitchRecord> read_switch_record(const std::filesystem::path& folder);

/// Removes the note, if there is one.
void remove_switch_record(const std::filesystem::path& folder) noexcept;

} // namespace overt
