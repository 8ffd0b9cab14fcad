/// Closing the record of a sitting whose program came to a sudden end.
#pragma once

#include <filesystem>
#include <string>

namespace overt {

/// Marks the attempt that was running as interrupted, writes an event that says at what the program crashed,
/// seals what was not sealed yet, notes that the last sitting is closed, and folds the log into the file.
/// False, and nothing done, if it was closed already. Throws RecordError if the session cannot be written to,
/// or another program records into it.
bool close_crashed_sitting(const std::filesystem::path& session_file, const std::string& what);

} // namespace overt
