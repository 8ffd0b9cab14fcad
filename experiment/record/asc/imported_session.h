/// A session file that is written at once instead of in the course of a session.
#pragma once

#include <filesystem>
#include <functional>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/record/session_header.h"

namespace overt {

/// Opens the file, has `write` insert its rows in one transaction, and leaves one file without a log. What is
/// written this way is to lie in a folder that nobody sees yet: a program that is killed leaves it half done.
/// Throws RecordError, and whatever `write` throws but SQLite's own.
void write_session_rows(const std::filesystem::path& session_file,
                        const std::function<void(SQLite::Database&)>& write);

/// When all its files are there: seals all rows anew, for they are others than before, and writes the
/// manifest. A session file of an earlier format stays without seals. Throws RecordError.
void finish_imported_session(const std::filesystem::path& folder, const ProgramBuild& program);

} // namespace overt
