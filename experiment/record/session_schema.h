/// The tables of a session file. docs/session_format.md explains them to other programs.
#pragma once

#include <cstdint>

namespace overt {

/// PRAGMA application_id of a session file: «Ovrt» in ASCII. file(1) and every reader can tell it from other
/// SQLite files by it.
inline constexpr std::int32_t session_application_id = 0x4f767274;

/// PRAGMA user_version. Raised whenever a reader of an older version would misread the file.
inline constexpr int session_schema_version = 2;

/// Name of the session file in a session's directory.
inline constexpr const char* session_file_name = "session.sqlite";

/// Statements that make the tables of an empty session.
extern const char* const session_schema_sql;

/// Statements that make the display box's tables where they are not there: sessions of earlier programs have
/// none.
extern const char* const box_tables_sql;

/// The same for what the observer was asked and what was said.
extern const char* const observer_tables_sql;

/// The same for the ledger's table of missed refreshes.
extern const char* const ledger_tables_sql;

/// The same for the tables of what a tracker said besides samples.
extern const char* const gaze_tables_sql;

} // namespace overt
