/// A session file may come from anybody. What reads it runs no statement of its own: no view, trigger or
/// virtual table, no text of it as SQL, nothing without an end.
#pragma once

#include <filesystem>

#include <SQLiteCpp/Database.h>

namespace overt {

/// Refuses what no session of any format has: views but `counted_trial`, triggers, virtual tables, columns
/// that are computed, and names of tables and columns that are more than letters, digits and "_", since
/// readers put them into statements. Throws RecordError naming the file and the first such thing.
void require_plain_schema(const SQLite::Database& database, const std::filesystem::path& file);

/// Takes from a connection what a reader does not need: it can only select and begin transactions, from
/// tables and pragmas that tell something; views of the file are off; functions that leave the file are
/// refused. A statement ends with an error when the program is asked to end (stop_request.h), and when it has
/// gone on far longer than one through all rows takes. Throws SQLite::Exception.
void guard_reader(SQLite::Database& database, const std::filesystem::path& file);

/// What is left to a writer: triggers of the file are off, and its schema is not trusted.
void guard_writer(SQLite::Database& database);

} // namespace overt
