#include "experiment/record/schema_migration.h"

#include <map>
#include <set>
#include <string>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/old_names.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// What a database has by name: tables or views, and the statements that made them.
std::map<std::string, std::string> statements_of(const SQLite::Database& database, const char* type) {
    std::map<std::string, std::string> statements;
    const std::string sql = fmt::format(
        "SELECT name, sql FROM sqlite_schema WHERE type = '{}' AND name NOT LIKE 'sqlite_%'", type);
    for (Query row(database, sql.c_str()); row.step();) {
        std::string name = row.text();
        statements[std::move(name)] = row.text();
    }
    return statements;
}

std::vector<std::string> columns_of(const SQLite::Database& database, const std::string& table) {
    std::vector<std::string> columns;
    for (Query row(database, fmt::format("SELECT name FROM pragma_table_info('{}')", table).c_str());
         row.step();)
        columns.push_back(row.text());
    return columns;
}

/// Puts a table's rows into one of today's making. Columns that are new get their defaults.
void remake(SQLite::Database& database, const std::string& table, std::string statement,
            const std::vector<std::string>& columns) {
    const std::vector<std::string> old_columns = columns_of(database, table);
    const std::set<std::string> known(old_columns.begin(), old_columns.end());
    std::vector<std::string> kept;
    for (const std::string& column : columns)
        if (known.contains(column))
            kept.push_back(column);
    const std::string begin = "CREATE TABLE " + table;
    OVERT_EXPECTS(statement.starts_with(begin));
    statement.replace(0, begin.size(), "CREATE TABLE remade");
    database.exec(statement);
    database.exec(fmt::format("INSERT INTO remade ({0}) SELECT {0} FROM {1}; DROP TABLE {1}; "
                              "ALTER TABLE remade RENAME TO {1}",
                              fmt::join(kept, ", "), table));
}

constexpr int first_version_with_fates = 3;

/// Earlier versions told in words what became of an attempt that failed.
void take_verdicts_from_events(SQLite::Database& database) {
    database.exec(R"sql(
UPDATE trial SET comes_again = (
    SELECT CASE WHEN detail LIKE '%does not come again%' THEN 'never'
                WHEN detail LIKE '%comes again now%' THEN 'now'
                WHEN detail LIKE '%at the end of the block%' THEN 'end-of-block' END
    FROM event WHERE kind = 'trial failed' AND event.sitting = trial.sitting AND event.trial = trial.trial
        AND at_ns >= started_ns
        AND NOT EXISTS (SELECT 1 FROM trial AS later WHERE later.trial_id > trial.trial_id
                        AND later.started_ns <= at_ns)
    ORDER BY event.id LIMIT 1)
WHERE status = 'aborted')sql");
}

void make_tables_of_today(SQLite::Database& database) {
    SQLite::Database today(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    make_session_tables(today);
    const auto before = statements_of(database, "table");
    // A view forbids that its tables are made anew.
    for (const auto& [view, statement] : statements_of(database, "view"))
        database.exec(fmt::format("DROP VIEW \"{}\"", view));
    for (const auto& [table, statement] : statements_of(today, "table")) {
        const auto old = before.find(table);
        if (old == before.end())
            database.exec(statement);
        else if (old->second != statement)
            remake(database, table, statement, columns_of(today, table));
    }
    for (const auto& [view, statement] : statements_of(today, "view"))
        database.exec(statement);
}

/// Into a file that is whole or not there.
void keep_copy(const fs::path& file, const fs::path& copy) {
    if (fs::exists(copy))
        return; // of an earlier try, which changed nothing
    fs::path unfinished = copy;
    unfinished += ".partial";
    std::error_code error;
    fs::copy_file(file, unfinished, fs::copy_options::overwrite_existing, error);
    if (!error)
        fs::rename(unfinished, copy, error);
    if (error)
        throw RecordError(fmt::format("{}: the copy that is kept of the session before it is brought to a "
                                      "newer format cannot be written: {}. Make room, or check the "
                                      "folder's permissions; the session is as it was.",
                                      copy.string(), error.message()));
}

int version_of(const SQLite::Database& database) {
    Query row(database, "PRAGMA user_version");
    return row.step() ? row.small() : 0;
}

void bring_to_today(SQLite::Database& database, int version) {
    SQLite::Transaction transaction(database);
    rename_to_today(database);
    make_tables_of_today(database);
    // Earlier programs hashed what frames are made from, and not their pixels.
    database.exec("UPDATE stimulus SET made_from_sha256 = frames_sha256, frames_sha256 = '' "
                  "WHERE made_from_sha256 = ''");
    if (version < first_version_with_fates)
        take_verdicts_from_events(database);
    database.exec(fmt::format("PRAGMA user_version = {}", session_schema_version));
    transaction.commit();
}

} // namespace

std::optional<fs::path> migrate_session_file(const fs::path& file, KeptCopy kept) {
    SQLite::Database database = open_session_file(file, SessionFileUse::write);
    try {
        const int version = version_of(database);
        if (version >= session_schema_version)
            return std::nullopt;
        // What a killed program left in the log goes into the file, so that the copy is all of it.
        if (!fold_log(database))
            throw RecordError(fmt::format("{}: another program has this session open, so that it cannot be "
                                          "brought to today's format: close it there, and try again.",
                                          file.string()));
        database.exec("PRAGMA synchronous = FULL; PRAGMA foreign_keys = OFF");
        std::optional<fs::path> copy;
        if (kept == KeptCopy::beside_it) {
            copy = file.parent_path() / fmt::format("session.version-{}.sqlite", version);
            keep_copy(file, *copy);
        }
        bring_to_today(database, version);
        return copy;
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "bringing the session to today's format", reason);
    }
}

} // namespace overt
