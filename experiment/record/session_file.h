/// Opening a session file, and refusing what is none.
#pragma once

#include <filesystem>

#include <SQLiteCpp/Database.h>

namespace overt {

enum class SessionFileUse { read, write };

/// Opens session.sqlite of any state: closed, in use, or left behind by a program that was killed. Throws
/// RecordError if there is none, if it is another kind of file, damaged, or written by a newer program.
SQLite::Database open_session_file(const std::filesystem::path& file, SessionFileUse use);

} // namespace overt
