#include "experiment/record/file_hash.h"

#include <algorithm>
#include <span>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "experiment/record/sql.h"

namespace overt {

ContentHash hash_of_folded_rows(const SQLite::Database& database) {
    sqlite3_file* file = nullptr;
    database.check(sqlite3_file_control(database.getHandle(), "main", SQLITE_FCNTL_FILE_POINTER, &file));
    sqlite3_int64 size = 0;
    database.check(file->pMethods->xFileSize(file, &size));
    ContentHasher hasher;
    std::vector<std::byte> piece(1 << 20);
    for (sqlite3_int64 at = 0; at < size; at += static_cast<sqlite3_int64>(piece.size())) {
        piece.resize(std::min(piece.size(), static_cast<std::size_t>(size - at)));
        database.check(file->pMethods->xRead(file, piece.data(), static_cast<int>(piece.size()), at));
        hasher.add_bytes(piece);
    }
    return hasher.finish();
}

void note_file_hash(SQLite::Database& database, const ContentHash& hash) {
    SQLite::Statement insert(database, "INSERT INTO file_hash VALUES (?)");
    run_statement(insert, hash);
}

void forget_file_hash(SQLite::Database& database) {
    database.exec(
        "CREATE TABLE IF NOT EXISTS file_hash (sha256 TEXT NOT NULL) STRICT; DELETE FROM file_hash");
}

std::optional<ContentHash> noted_file_hash(const SQLite::Database& database) {
    const auto hashes = read_later_rows(database, "file_hash", "SELECT sha256 FROM file_hash",
                                        [](Query& row) { return row.text(); });
    return hashes.empty() ? std::nullopt : std::optional(hashes.front());
}

} // namespace overt
