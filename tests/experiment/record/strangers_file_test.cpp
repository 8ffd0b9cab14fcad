/// Session files that somebody else made: nothing of them is run, and nothing goes on without an end.
#include "experiment/record/strangers_file.h"

#include <catch2/catch.hpp>
#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/base/stop_request.h"
#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// A whole session with something more in its file.
fs::path session_with(const fs::path& root, const std::string& statements) {
    const fs::path session = make_whole_session(root);
    write_whole_session(session);
    SQLite::Database database((session / session_file_name).string(), SQLite::OPEN_READWRITE);
    database.exec(statements);
    return session;
}

void check_is_refused(const fs::path& session, const std::string& words) {
    for (const SessionFileUse use : {SessionFileUse::read, SessionFileUse::as_it_is, SessionFileUse::write})
        CHECK_THROWS_WITH(open_session_file(session / session_file_name, use), Contains(words));
    CHECK_THROWS_AS(SessionRecord(session), RecordError);
    CHECK_FALSE(verify_session(session).is_sound());
}

/// Gives no row.
void refuses_or_ignores(const SQLite::Database& database, const std::string& sql) {
    INFO(sql);
    bool has_row = false;
    try {
        has_row = SQLite::Statement(database, sql).executeStep();
    } catch (const SQLite::Exception&) {
    }
    CHECK_FALSE(has_row);
}

} // namespace

TEST_CASE("views, triggers, virtual tables and names that are statements make a file no session", "[unit]") {
    const TemporaryFolder root;
    check_is_refused(
        session_with(root.path(),
                     "ALTER TABLE event RENAME TO real_event; CREATE VIEW event AS SELECT * FROM real_event"),
        "a view \"event\"");
    check_is_refused(
        session_with(root.path(), "CREATE TRIGGER t AFTER INSERT ON sitting BEGIN DELETE FROM trial; END"),
        "a trigger \"t\"");
    check_is_refused(session_with(root.path(), "CREATE VIRTUAL TABLE v USING rtree(id, low, high)"),
                     "a virtual table");
    check_is_refused(session_with(root.path(), "CREATE TABLE \"a\"\"b\" (x)"), "a name");
    check_is_refused(session_with(root.path(), "CREATE TABLE extra (\"x, (SELECT 1) AS y\" INTEGER)"),
                     "a column");
    check_is_refused(session_with(root.path(), "CREATE TABLE extra (x INTEGER, y AS (x + 1))"),
                     "a column \"extra.y\"");
    CHECK_NOTHROW(SessionRecord(session_with(root.path(), "CREATE TABLE extra (x INTEGER)")));
}

TEST_CASE("names of tables and columns are letters, digits and underscores", "[unit]") {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    const auto is_refused = [&](const std::string& table, const std::string& column) {
        database.exec("CREATE TABLE \"" + table + "\" (\"" + column + "\")");
        bool refused = false;
        try {
            require_plain_schema(database, "a");
        } catch (const RecordError&) {
            refused = true;
        }
        database.exec("DROP TABLE \"" + table + "\"");
        return refused;
    };
    for (const char c : std::string("azAZ09_m"))
        CHECK_FALSE((is_refused(std::string(1, c), "x") || is_refused("t", std::string(1, c))));
    for (const char c : std::string("`{@[/: '-(\x7f")) // those beside the ranges, too
        CHECK((is_refused(std::string("t") + c, "x") && is_refused("t", std::string("x") + c)));
    CHECK_FALSE(is_refused(std::string(64, 't'), std::string(64, 'x')));
    CHECK(is_refused(std::string(65, 't'), "x"));
    CHECK(is_refused("t", std::string(65, 'x')));
}

TEST_CASE("what a seal says of columns is no statement", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = session_with(
        root.path(),
        "UPDATE sealed_table SET columns = '(SELECT group_concat(sql) FROM sqlite_schema)' "
        "WHERE name = 'session'; UPDATE sealed_table SET columns = '1 FROM event; --' WHERE name = 'trial'");
    std::string words;
    for (const Damage& damage : verify_session(session).damages)
        words += to_text(damage) + "\n";
    INFO(words);
    CHECK_THAT(words, Contains("name = session: names columns that the table does not have"));
    CHECK_THAT(words, Contains("name = trial: names columns that the table does not have"));
}

TEST_CASE("a reader's connection selects and does nothing else", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = session_with(root.path(), "CREATE TABLE extra (x INTEGER)");
    const SQLite::Database database = open_session_file(session / session_file_name, SessionFileUse::read);
    const auto refuses = [&](const std::string& sql) {
        INFO(sql);
        CHECK_THROWS_AS(SQLite::Statement(database, sql).executeStep(), SQLite::Exception);
    };
    refuses("SELECT load_extension('x')");
    refuses("ATTACH 'other.sqlite' AS other");
    refuses("CREATE TEMP TABLE t (x)");
    refuses("PRAGMA journal_mode = DELETE");
    refuses("PRAGMA writable_schema = 1");
    refuses("INSERT INTO extra VALUES (1)");
    refuses("SELECT * FROM counted_trial");
    refuses("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n");
    for (const char* const word : {"selects", "PRAGMA writable_schemas", "PRAGMA foreign_keys = 0",
                                   "PRAGMA user", "PRAGMA user_versions", "PRAGMA synchronous"})
        refuses_or_ignores(database, word);
    for (const char* const tells : {"PRAGMA user_version", "PRAGMA Journal_Mode", "PRAGMA table_info(trial)",
                                    "PRAGMA page_count", "SELECT upper('a')", "SELECT count(*) FROM trial"}) {
        INFO(tells);
        CHECK(SQLite::Statement(database, tells).executeStep());
    }
}

TEST_CASE("a statement without an end ends, and each one when the program is asked to", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = session_with(root.path(), "CREATE TABLE extra (x INTEGER)");
    const SQLite::Database database = open_session_file(session / session_file_name, SessionFileUse::read);
    const auto ends_with = [&](const std::string& sql) {
        try {
            SQLite::Statement statement(database, sql);
            while (statement.executeStep()) {
            }
        } catch (const SQLite::Exception& error) {
            return error.getErrorCode();
        }
        return SQLITE_OK;
    };
    // Some 10^14 rows.
    const std::string endless = "SELECT count(*) FROM sample a, sample b, sample c, sample d, sample e";
    CHECK(ends_with(endless) == SQLITE_INTERRUPT);
    // What one took is not counted against the next.
    CHECK(ends_with("SELECT count(*) FROM sample a, sample b") == SQLITE_OK);
    stop_check().store([]() noexcept { return true; });
    CHECK(ends_with("SELECT count(*) FROM sample a, sample b") == SQLITE_INTERRUPT);
    stop_check().store(nullptr);
}

TEST_CASE("seals that are broken are told without looking at anything else", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = session_with(root.path(), "SELECT 1");
    CHECK(broken_seals(session).empty());
    fs::remove(session / "protocol.toml"); // no row
    CHECK(broken_seals(session).empty());
    const fs::path changed =
        session_with(root.path(), "UPDATE sample SET x_px = 1.0 WHERE trial_id = 1 AND n = 7");
    const std::vector<std::string> found = broken_seals(changed / session_file_name);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found.front(), Contains("table sample") && Contains("is not as it was sealed"));
    CHECK(broken_seals(root.path() / "nowhere").empty());
}

TEST_CASE("connections to a stranger's file have off what could run something, and limits to what is read",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / "a.sqlite";
    const auto is_on = [](SQLite::Database& database, int which) {
        int value = -1;
        sqlite3_db_config(database.getHandle(), which, -1, &value);
        return value;
    };
    {
        SQLite::Database writer(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        writer.exec("CREATE TABLE t (x)");
        guard_writer(writer);
        CHECK(is_on(writer, SQLITE_DBCONFIG_ENABLE_TRIGGER) == 0);
        CHECK(is_on(writer, SQLITE_DBCONFIG_TRUSTED_SCHEMA) == 0);
        CHECK(is_on(writer, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION) == 0);
        CHECK(is_on(writer, SQLITE_DBCONFIG_DEFENSIVE) == 1);
    }
    SQLite::Database reader(file.string(), SQLite::OPEN_READONLY);
    guard_reader(reader, file);
    CHECK(is_on(reader, SQLITE_DBCONFIG_ENABLE_VIEW) == 0);
    CHECK(is_on(reader, SQLITE_DBCONFIG_ENABLE_TRIGGER) == 0);
    CHECK(is_on(reader, SQLITE_DBCONFIG_TRUSTED_SCHEMA) == 0);
    CHECK(is_on(reader, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION) == 0);
    CHECK(is_on(reader, SQLITE_DBCONFIG_DEFENSIVE) == 1);
    CHECK(sqlite3_limit(reader.getHandle(), SQLITE_LIMIT_ATTACHED, -1) == 0);
    CHECK(sqlite3_limit(reader.getHandle(), SQLITE_LIMIT_LENGTH, -1) == 268'435'456);
    CHECK(sqlite3_limit(reader.getHandle(), SQLITE_LIMIT_TRIGGER_DEPTH, -1) == 0);
}
