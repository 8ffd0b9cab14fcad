/// The hash of all bytes of session.sqlite while a session runs, so that a changed byte is found where no row
/// is, too.
///
/// Between two checkpoints nothing is written to that file, for all rows go into the log. So its hash is
/// noted after a checkpoint, by the next transaction, and forgotten by the last one before the next
/// checkpoint: what is noted stands in the log alone and is true whenever the program is killed.
#pragma once

#include <optional>

#include "experiment/base/content_hash.h"

namespace SQLite {
class Database;
}

namespace overt {

/// Of the file without its log. Through SQLite's own handle: closing another one of the same file would take
/// away the locks that SQLite has on it (POSIX). Throws SQLite::Exception.
ContentHash hash_of_folded_rows(const SQLite::Database& database);

/// In the open transaction. Throws SQLite::Exception.
void note_file_hash(SQLite::Database& database, const ContentHash& hash);

/// In the open transaction. Makes the table if there is none, as in sessions of earlier programs. Throws
/// SQLite::Exception.
void forget_file_hash(SQLite::Database& database);

/// Nothing if none is noted now. Throws SQLite::Exception.
std::optional<ContentHash> noted_file_hash(const SQLite::Database& database);

} // namespace overt
