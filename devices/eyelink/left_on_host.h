/// Data files that a session could not fetch from the EyeLink's host: noted on disk, so that they are offered
/// again when the host is next reached.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace overt {

struct LeftOnHost {
    std::string name;             ///< of the file, without ".EDF"
    std::string host;             ///< its network address
    std::filesystem::path folder; ///< where it belongs
    bool operator==(const LeftOnHost&) const = default;
};

/// Those that are noted in the folder; none if nothing is. Throws RecordError if the note cannot be read.
std::vector<LeftOnHost> read_left_on_host(const std::filesystem::path& notes);

/// Adds one to the note, which is made if need be; once, however often it is added. It is on disk when this
/// returns. Throws RecordError.
void note_left_on_host(const std::filesystem::path& notes, const LeftOnHost& left);

/// Takes one out of the note, if it is in it. Throws RecordError.
void forget_left_on_host(const std::filesystem::path& notes, const LeftOnHost& left);

} // namespace overt
