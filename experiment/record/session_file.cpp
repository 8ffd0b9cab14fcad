#include "experiment/record/session_file.h"

#include <thread>

#include <fmt/format.h>
#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/old_names.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "experiment/record/strangers_file.h"

namespace overt {
namespace {

std::int64_t pragma(const SQLite::Database& database, const char* sql) {
    Query query(database, sql);
    return query.step() ? query.integer() : 0;
}

void check_identity(const SQLite::Database& database, const std::filesystem::path& file) {
    if (pragma(database, "PRAGMA application_id") != session_application_id)
        throw RecordError(
            fmt::format("{}: this is an SQLite file, but not a session of overt.", file.string()));
    const std::int64_t version = pragma(database, "PRAGMA user_version");
    if (version > session_schema_version)
        throw NewerFormatError(
            fmt::format("{}: written by a newer overt (session format {}, this program knows {} "
                        "and older): update overt to read it.",
                        file.string(), version, session_schema_version));
    if (version < 1)
        throw RecordError(fmt::format("{}: session format {} does not exist: the file is damaged.",
                                      file.string(), version));
}

SQLite::Database open_for_reading(const std::filesystem::path& file, SessionFileUse use) {
    SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
    // Readers wait while a writer folds its file.
    database.setBusyTimeout(2'000);
    check_identity(database, file);
    require_plain_schema(database, file);
    if (use == SessionFileUse::read &&
        pragma(database, "PRAGMA user_version") < first_version_with_todays_names)
        show_todays_names(database);
    guard_reader(database, file);
    return database;
}

SQLite::Database open_for_writing(const std::filesystem::path& file) {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.setBusyTimeout(writer_patience_ms);
    // Rows go from the log into the file only where that is meant (file_hash.h).
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    guard_writer(database);
    check_identity(database, file);
    require_plain_schema(database, file);
    return database;
}

/// SQLite follows links, and opens whatever lies where its own files may be.
void require_own_files(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    const std::string name = file.filename().string();
    for (const char* const of_database : {"", "-wal", "-shm", "-journal"}) {
        const std::string why = why_no_file_inside(folder, name + of_database);
        if (!why.empty() && why != "is missing")
            throw RecordError(fmt::format("{}{}: {}. Nothing outside of a session's folder is read.",
                                          file.string(), of_database, why));
    }
}

} // namespace

SQLite::Database open_session_file(const std::filesystem::path& file, SessionFileUse use) {
    if (!std::filesystem::is_regular_file(file)) {
        const std::string missing = fmt::format("{}: there is no session file here.", file.string());
        // To be read, a session is named by the user; to be written, by the program that has just made it.
        if (use != SessionFileUse::write)
            throw InputError(missing);
        throw RecordError(missing);
    }
    require_own_files(file);
    try {
        try {
            return use == SessionFileUse::write ? open_for_writing(file) : open_for_reading(file, use);
        } catch (const SQLite::Exception& reason) {
            if (use == SessionFileUse::write || reason.getExtendedErrorCode() != SQLITE_READONLY_ROLLBACK)
                throw;
        }
        // A program that was killed while it changed the file itself (it does so when it begins and when it
        // ends) has left a journal with the bytes of before: SQLite puts them back for whoever may write.
        open_for_writing(file);
        return open_for_reading(file, use);
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "opening the session", reason);
    }
}

bool fold_log(SQLite::Database& database, std::chrono::milliseconds patience) {
    // SQLite's own patience does not cover this step: whoever has the file open makes it fail at once.
    const auto deadline = std::chrono::steady_clock::now() + patience;
    for (;;) {
        const int code = database.tryExec("PRAGMA journal_mode = DELETE");
        if (code == SQLITE_OK)
            return true;
        if (code != SQLITE_BUSY && code != SQLITE_LOCKED)
            throw SQLite::Exception(database.getHandle(), code);
        if (std::chrono::steady_clock::now() >= deadline)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

bool fold_session_file(const std::filesystem::path& file) {
    try {
        SQLite::Database database = open_session_file(file, SessionFileUse::write);
        return fold_log(database);
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "folding the session into one file", reason);
    }
}

} // namespace overt
