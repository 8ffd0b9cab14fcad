#include "experiment/record/sql.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::string_view remedy_for(int error_code) {
    if (error_code == SQLITE_READONLY_DBMOVED)
        return "What was recorded is in the moved file: put the folder back where it was, and go on with "
               "--resume";
    switch (error_code & 0xff) {
    case SQLITE_FULL:
        return "The disk is full: make room; a session that was running can go on with --resume";
    case SQLITE_IOERR:
        return "The disk refuses to write or read: check its space, its quota and its cable; a session "
               "that was running can go on with --resume";
    case SQLITE_CORRUPT:
        return "The file is damaged: work on a copy and try the sqlite3 program's .recover on it";
    case SQLITE_NOTADB:
        return "This is not a session file, or its beginning was overwritten";
    case SQLITE_CANTOPEN:
        return "Check that the file is there; a session that was not closed also needs its -wal file beside "
               "it and a directory that can be written to";
    case SQLITE_READONLY:
    case SQLITE_PERM:
        return "Check the permissions of the file and of its directory";
    case SQLITE_INTERRUPT:
        return "The program was asked to end, or a statement went on far longer than this file's rows can "
               "take";
    case SQLITE_AUTH:
        return "The file asks for what no session needs: it is not read further";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return "Another program is writing to it: close that first";
    default:
        return "Check the disk and the file's permissions";
    }
}

} // namespace

Query::Query(const SQLite::Database& database, const char* sql) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    database.check(sqlite3_prepare_v2(database.getHandle(), sql, -1, &statement, nullptr));
    statement_.reset(statement);
}

void Query::Finalizer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Query& Query::bind(int index, std::int64_t value) {
    database_.check(sqlite3_bind_int64(statement_.get(), index, value));
    return *this;
}

bool Query::step() {
    column_ = 0;
    const int result = sqlite3_step(statement_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        database_.check(result);
    return result == SQLITE_ROW;
}

std::int64_t Query::integer() { return sqlite3_column_int64(statement_.get(), column_++); }

SessionTime Query::session_time() {
    constexpr std::int64_t farthest_ns = 1'000'000'000'000'000'000; // 31 years
    const std::int64_t ns = integer();
    if (ns > farthest_ns || ns < -farthest_ns)
        throw RecordError(fmt::format("the session file holds a time of {} ns: it is damaged.", ns));
    return SessionTime(SessionDuration(ns));
}

TrackerTime Query::tracker_time() {
    // 126 years: some trackers count from 1970, and nanoseconds of it still fit.
    constexpr std::int64_t farthest_us = 4'000'000'000'000'000;
    const std::int64_t us = integer();
    if (us > farthest_us || us < -farthest_us)
        throw RecordError(
            fmt::format("the session file holds a tracker's time of {} us: it is damaged.", us));
    return overt::tracker_time(us);
}

double Query::real() { return sqlite3_column_double(statement_.get(), column_++); }

std::string Query::text() {
    const int column = column_++;
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    const int length = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr ? std::string() : std::string(bytes, static_cast<std::size_t>(length));
}

std::string Query::bytes() {
    const int column = column_++;
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int length = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr ? std::string() : std::string(bytes, static_cast<std::size_t>(length));
}

bool Query::skip_null() {
    const bool is_null = sqlite3_column_type(statement_.get(), column_) == SQLITE_NULL;
    column_ += is_null;
    return is_null;
}

bool has_column(const SQLite::Database& database, const char* table, const char* column) {
    Query row(
        database,
        fmt::format("SELECT COUNT(*) FROM pragma_table_info('{}') WHERE name = '{}'", table, column).c_str());
    return row.step() && row.integer() > 0;
}

bool has_table(const SQLite::Database& database, const char* table) {
    Query row(database,
              fmt::format("SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = '{}'", table).c_str());
    return row.step();
}

void throw_record_error(const std::filesystem::path& file, std::string_view doing,
                        const SQLite::Exception& reason) {
    throw RecordError(fmt::format("{}: {} failed: {}. {}.", file.string(), doing, reason.what(),
                                  remedy_for(reason.getErrorCode())));
}

} // namespace overt
