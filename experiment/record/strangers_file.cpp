#include "experiment/record/strangers_file.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/base/stop_request.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// The one view of a session: for people, and never read by the program.
constexpr std::string_view own_view = "counted_trial";

bool is_plain_identifier(std::string_view name) {
    return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

/// Of a name that may hold anything.
std::string sql_text(std::string_view name) {
    std::string text = "'";
    for (const char c : name)
        text += c == '\'' ? std::string("''") : std::string(1, c);
    return text + "'";
}

/// How far a statement has come, and how far it may go.
struct StatementBudget {
    std::int64_t most_rounds = 0;
    std::atomic<std::int64_t> rounds{0};
};

/// So many instructions of SQLite's virtual machine pass between two looks.
constexpr int instructions_of_round = 20'000;
/// A statement that has gone on for so many of them ends when the program is asked to. Shorter ones end by
/// themselves sooner than it matters, and leave it to the command to say what is left undone.
constexpr std::int64_t rounds_before_stop = 100;
/// A pass through all rows takes some 600,000 instructions for a mebibyte; sorting and joining, ten times
/// that.
constexpr std::int64_t instructions_at_least = 100'000'000, instructions_of_mebibyte = 20'000'000;

int go_on_or_end(void* budget) {
    auto& of = *static_cast<StatementBudget*>(budget);
    const std::int64_t rounds = of.rounds.fetch_add(1, std::memory_order_relaxed);
    return rounds >= of.most_rounds || (rounds >= rounds_before_stop && stop_is_requested());
}

int statement_begins(unsigned, void* budget, void*, void*) {
    static_cast<StatementBudget*>(budget)->rounds.store(0, std::memory_order_relaxed);
    return 0;
}

/// Pragmas that tell something and change nothing.
constexpr std::string_view telling_pragmas[] = {"user_version", "application_id",  "table_info",
                                                "table_xinfo",  "integrity_check", "journal_mode",
                                                "page_count",   "page_size"};

bool is_same_word(std::string_view a, std::string_view b) {
    return sqlite3_strnicmp(a.data(), b.data(), static_cast<int>(std::max(a.size(), b.size()))) == 0 &&
           a.size() == b.size();
}

/// sqlite3_set_authorizer: `what` is done to `first` and `second`, which mean by it what its documentation
/// says.
int allow_readers_things(void*, int what, const char* first, const char* second, const char*, const char*) {
    switch (what) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_TRANSACTION:
    case SQLITE_SAVEPOINT:
        return SQLITE_OK;
    case SQLITE_UPDATE:
        // SQLite asks this before it looks through a schema; a file that is read only, with its schema
        // defended, is not changed by it.
        return first && is_same_word(first, "sqlite_master") ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_FUNCTION: // second: its name
        return second && is_same_word(second, "load_extension") ? SQLITE_DENY : SQLITE_OK;
    case SQLITE_PRAGMA: { // first: its name, second: what it is set to, or of which table it tells
        const bool tells = first && std::ranges::any_of(telling_pragmas, [&](std::string_view name) {
                               return is_same_word(first, name);
                           });
        const bool sets = second && first && is_same_word(first, "journal_mode");
        return tells && !sets ? SQLITE_OK : SQLITE_DENY;
    }
    default:
        return SQLITE_DENY;
    }
}

void refuse(const std::filesystem::path& file, std::string_view what, const std::string& name) {
    throw RecordError(fmt::format("{}: holds {} \"{}\", which no overt has made: this is no session that was "
                                  "recorded, or somebody changed it. It is not read.",
                                  file.string(), what, name));
}

} // namespace

void require_plain_schema(const SQLite::Database& database, const std::filesystem::path& file) {
    std::vector<std::string> tables;
    for (Query row(database,
                   "SELECT type, name, upper(substr(ltrim(coalesce(sql, '')), 1, 14)) FROM sqlite_schema");
         row.step();) {
        const std::string type = row.text(), name = row.text(), begin = row.text();
        if (type == "trigger" || (type == "view" && name != own_view))
            refuse(file, type == "view" ? "a view" : "a trigger", name);
        if (type == "table" && begin == "CREATE VIRTUAL")
            refuse(file, "a virtual table", name);
        if (!is_plain_identifier(name))
            refuse(file, "a name", name);
        if (type == "table")
            tables.push_back(name);
    }
    for (const std::string& table : tables)
        for (Query row(
                 database,
                 fmt::format("SELECT name, hidden FROM pragma_table_xinfo({})", sql_text(table)).c_str());
             row.step();) {
            const std::string column = row.text();
            if (!is_plain_identifier(column) || row.integer() != 0)
                refuse(file, "a column", fmt::format("{}.{}", table, column));
        }
}

void guard_reader(SQLite::Database& database, const std::filesystem::path& file) {
    sqlite3* const handle = database.getHandle();
    for (const int off : {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                          SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION})
        sqlite3_db_config(handle, off, 0, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, 256 << 20);
    sqlite3_limit(handle, SQLITE_LIMIT_TRIGGER_DEPTH, 0);
    std::error_code error;
    const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
    auto budget = std::make_unique<StatementBudget>();
    budget->most_rounds = (instructions_at_least + (error ? 0 : bytes >> 20) * instructions_of_mebibyte) /
                          instructions_of_round;
    // The connection owns it: SQLite releases what a function was registered with when it closes.
    StatementBudget* const of_connection = budget.release();
    database.check(sqlite3_create_function_v2(
        handle, "overt_statement_budget", 0, SQLITE_UTF8 | SQLITE_DIRECTONLY, of_connection,
        [](sqlite3_context* context, int, sqlite3_value**) { sqlite3_result_null(context); }, nullptr,
        nullptr, [](void* owned) { delete static_cast<StatementBudget*>(owned); }));
    sqlite3_progress_handler(handle, instructions_of_round, go_on_or_end, of_connection);
    sqlite3_trace_v2(handle, SQLITE_TRACE_STMT, statement_begins, of_connection);
    sqlite3_set_authorizer(handle, allow_readers_things, nullptr);
}

void guard_writer(SQLite::Database& database) {
    for (const int off : {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_TRUSTED_SCHEMA,
                          SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION})
        sqlite3_db_config(database.getHandle(), off, 0, nullptr);
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

} // namespace overt
