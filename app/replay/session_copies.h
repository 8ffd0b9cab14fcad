/// Copies of what a recorded session has: the session itself is only read.
#pragma once

#include <filesystem>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Into folders that are made for it. Throws RecordError.
void copy_file_to(const std::filesystem::path& from, const std::filesystem::path& to);

/// The same of a session file, with what a log beside it still holds.
void copy_session_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Puts a session's maps in the place of those of another that have the same pixels: the hashes of maps are
/// over their files, in which older versions of the program wrote the time of day. Throws RecordError.
void take_map_files(const SessionRecord& from, const std::filesystem::path& into);

} // namespace overt
