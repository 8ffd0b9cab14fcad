/// A session's header as rows of its tables, there and back.
#pragma once

#include <filesystem>

#include "experiment/record/session_header.h"

namespace SQLite {
class Database;
}

namespace overt {

/// Makes a session file with all tables and this header, synced to disk. The file must not exist. Throws
/// RecordError.
void create_session_file(const std::filesystem::path& file, const SessionHeader& header);

/// Reads the header back. Throws SQLite::Exception, and RecordError if a row that must be there is not.
SessionHeader read_session_header(const SQLite::Database& database);

} // namespace overt
