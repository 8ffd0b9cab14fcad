/// The tables of a session file. docs/session_format.md explains them to other programs.
#pragma once

#include <cstdint>

namespace SQLite {
class Database;
}

namespace overt {

/// PRAGMA application_id of a session file: "Ovrt" in ASCII. file(1) and every reader can tell it from other
/// SQLite files by it.
inline constexpr std::int32_t session_application_id = 0x4f767274;

/// PRAGMA user_version. Raised whenever a reader of an older version would misread the file: 2 has maps of
/// coordinates, 3 attempts that are completed and do not count, 4 names of tables and columns that were
/// others (old_names.h). See schema_migration.h.
inline constexpr int session_schema_version = 4;

/// Sessions of earlier versions have no chain of seals (seal_chain.h).
inline constexpr int first_version_with_seals = 3;

/// Name of the session file in a session's directory.
inline constexpr const char* session_file_name = "session.sqlite";

/// Folder in a session's directory in which each further tracker has its record, in a folder of its name: a
/// session's directory of its own, whose maps and meshes are the same files.
inline constexpr const char* further_records_folder = "trackers";

/// Statements that make the display box's tables where they are not there: sessions of earlier programs have
/// none.
extern const char* const box_tables_sql;

/// The same for what the observer was asked and what was said.
extern const char* const observer_tables_sql;

/// The same for the ledger's table of missed refreshes.
extern const char* const answer_tables_sql; ///< what was answered by keys, the mouse or boxes
extern const char* const ledger_tables_sql;

/// The same for the tables of places on surfaces, of the marks there, and of what was set with gauges.
extern const char* const probe_tables_sql;

/// The same for the tables of slots, and of what was shown in them.
extern const char* const slot_tables_sql;

/// The same for the tables of what a tracker said besides samples, or the program said of them.
extern const char* const gaze_tables_sql;

/// The same for the tables of response boxes, of keys that were pressed, and of markers.
extern const char* const device_tables_sql;

/// The same for the table of the options that sittings were run with.
extern const char* const option_tables_sql;

/// Makes all of them in an empty database. Throws SQLite::Exception.
void make_session_tables(SQLite::Database& database);

/// Adds to a session of today's version, which an earlier program began, the tables and the columns that the
/// rows of attempts go into. Throws SQLite::Exception.
void complete_session_tables(SQLite::Database& database);

} // namespace overt
