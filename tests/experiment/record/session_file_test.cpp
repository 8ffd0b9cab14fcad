#include "experiment/record/session_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <optional>
#include <thread>

#include <catch2/catch.hpp>
#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/file_hash.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("a record that names files outside of its folder is refused, whatever names them", "[unit]") {
    for (const char* const change :
         {"UPDATE object SET mesh_file = '../../secret.ply' WHERE object = 0",
          "UPDATE object SET mesh_file = '/etc/passwd' WHERE object = 1",
          "UPDATE map SET file = 'maps/../../x.exr' WHERE pose = 0",
          "UPDATE map SET file = '' WHERE pose = 0", "UPDATE object SET id = '../x' WHERE object = 0",
          "UPDATE task SET id = 'a/b' WHERE task = 0", "UPDATE material SET id = '..' WHERE material = 1",
          "UPDATE session SET protocol_name = '../..'", "UPDATE session SET observer_label = '../a'"}) {
        CAPTURE(change);
        const TemporaryFolder root;
        const fs::path file = root.path() / session_file_name;
        create_session_file(file, example_header());
        CHECK_NOTHROW(SessionRecord(root.path()));
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(change);
        CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("cannot be right: the file is damaged"));
    }
}

TEST_CASE("an answer's file outside of the session is refused", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name;
    create_session_file(file, example_header());
    {
        SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
        database.exec("INSERT INTO sitting (sitting, started_utc, closed) VALUES (9, '', 1)");
        database.exec("INSERT INTO trial (trial_id, sitting, trial, attempt, task, object, material, status, "
                      "started_ns) VALUES (1, 9, 0, 1, 0, 0, 0, 'completed', 0)");
        database.exec(
            "INSERT INTO answer_recording VALUES (1, '../../secret.wav', '', '', 1, 1, 16, 0, 1, 0, 0, 0, "
            "0, 0, 0, 0, NULL, NULL, '')");
    }
    const SessionRecord record(root.path());
    REQUIRE(record.trials().size() == 1);
    CHECK_THROWS_WITH(record.answer_recording(record.trials()[0]), Contains("outside of the session"));
}

TEST_CASE("a manifest that lists files outside of the session is refused", "[unit]") {
    const TemporaryFolder root;
    const auto with_path = [&](const std::string& path) {
        SessionManifest manifest;
        manifest.files = {{path, 1, hash_of_text("x")}};
        std::ofstream(root.path() / manifest_file_name) << to_text(manifest);
    };
    with_path("../secret");
    CHECK_THROWS_WITH(read_manifest(root.path()), Contains("outside of the session"));
    with_path("/etc/passwd");
    CHECK_THROWS_WITH(read_manifest(root.path()), Contains("outside of the session"));
}

TEST_CASE("names stay in their folder or do not", "[unit]") {
    for (const char* const inside : {"a", "a/b", "./a", "a/../b", "..a", "a..", "maps/bust/pose_00.exr"}) {
        CAPTURE(inside);
        CHECK(stays_inside(inside));
    }
    for (const char* const outside : {"", "..", "../a", "a/../..", "a/../../b", "/", "/a", "./.."}) {
        CAPTURE(outside);
        CHECK_FALSE(stays_inside(outside));
    }
    CHECK_FALSE(stays_inside(std::string_view("a\0b", 3)));
    CHECK(is_plain_name("bust"));
    for (const char* const name : {"a/b", ".", "..", "", "/a", "./a"})
        CHECK_FALSE(is_plain_name(name));
}

TEST_CASE("files that are no session are refused with the reason", "[unit]") {
    const TemporaryFolder root;
    CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("no session file here"));

    const fs::path file = root.path() / session_file_name;
    SECTION("a text file") {
        std::ofstream(file) << std::string(5000, 'x');
        CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("not a session file"));
    }
    SECTION("another SQLite file") {
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
            .exec("CREATE TABLE a (b)");
        CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("not a session of overt"));
    }
    SECTION("a session of a newer program") {
        create_session_file(file, example_header());
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
        CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("newer overt") && Contains("99"));
        CHECK_THROWS_AS(SessionStore(file, patient()), RecordError);
    }
    SECTION("a session of no format") {
        create_session_file(file, example_header());
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 0");
        CHECK_THROWS_WITH(open_session_file(file, SessionFileUse::as_it_is),
                          Contains("session format 0 does not exist"));
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 1");
        CHECK_NOTHROW(open_session_file(file, SessionFileUse::as_it_is));
    }
    SECTION("a session whose pages were overwritten") {
        create_session_file(file, example_header());
        const auto size = static_cast<std::streamoff>(fs::file_size(file));
        {
            std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
            stream.seekp(4096);
            stream << std::string(static_cast<std::size_t>(size) - 4096, '\x55');
        }
        CHECK_THROWS_WITH(SessionRecord(root.path()), Contains("damaged"));
    }
    SECTION("a protocol text that was changed afterwards") {
        create_session_file(file, example_header());
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE)
            .exec("UPDATE session SET protocol_text = 'other'");
        CHECK(SessionRecord(root.path()).damages().size() == 1);
    }
}

TEST_CASE("rows stay in the log when a writer ends, until they are folded into the file", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name, log = file.string() + "-wal";
    create_session_file(file, example_header());
    const std::string before = text_of(file);
    {
        SQLite::Database database = open_session_file(file, SessionFileUse::write);
        database.exec("PRAGMA journal_mode = WAL");
        database.exec("INSERT INTO block VALUES (0, 'one')");
    }
    CHECK(fs::file_size(log) > 0);
    CHECK(text_of(file).substr(100) == before.substr(100)); // the first bytes say how it is written
    CHECK(fold_session_file(file));
    CHECK_FALSE(fs::exists(log));
    SQLite::Database database = open_session_file(file, SessionFileUse::read);
    CHECK(database.execAndGet("SELECT id FROM block").getString() == "one");
}

TEST_CASE("the hash of a session's file is that of all its bytes, and stands beside its rows", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name;
    create_session_file(file, example_header());
    for (const int bytes : {0, 1 << 20, 3'000'000}) {
        SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
        database.exec("CREATE TABLE more (bytes); INSERT INTO more VALUES (randomblob(" +
                      std::to_string(bytes) + "))");
        CHECK(hash_of_folded_rows(database) == hash_of_text(text_of(file)));
        database.exec("DROP TABLE more; VACUUM");
    }
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    CHECK_FALSE(noted_file_hash(database));
    for (const char* const text : {"a", "b"}) {
        forget_file_hash(database);
        CHECK_FALSE(noted_file_hash(database));
        note_file_hash(database, hash_of_text(text));
        CHECK(noted_file_hash(database) == hash_of_text(text));
    }
}

TEST_CASE("times in a file are those of decades, to the last nanosecond", "[unit]") {
    const SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    const auto row = [&](std::int64_t value) {
        Query query(database, ("SELECT " + std::to_string(value)).c_str());
        query.step();
        return query;
    };
    constexpr std::int64_t most_ns = 1'000'000'000'000'000'000, most_us = 4'000'000'000'000'000;
    for (const std::int64_t sign : {-1, 1}) {
        CHECK(row(sign * most_ns).session_time() == SessionTime(SessionDuration(sign * most_ns)));
        CHECK_THROWS_AS(row(sign * (most_ns + 1)).session_time(), RecordError);
        CHECK(row(sign * most_us).tracker_time() == tracker_time(sign * most_us));
        CHECK_THROWS_AS(row(sign * (most_us + 1)).tracker_time(), RecordError);
    }
}

TEST_CASE("an error of the record says what was being done, and what helps", "[unit]") {
    for (const auto& [code, remedy] : {std::pair(SQLITE_FULL, "The disk is full"),
                                       {SQLITE_IOERR, "The disk refuses"},
                                       {SQLITE_IOERR_WRITE, "The disk refuses"},
                                       {SQLITE_CORRUPT, "The file is damaged"},
                                       {SQLITE_NOTADB, "not a session file"},
                                       {SQLITE_CANTOPEN, "Check that the file is there"},
                                       {SQLITE_READONLY, "Check the permissions"},
                                       {SQLITE_READONLY_DBMOVED, "in the moved file"},
                                       {SQLITE_PERM, "Check the permissions"},
                                       {SQLITE_INTERRUPT, "asked to end"},
                                       {SQLITE_AUTH, "not read further"},
                                       {SQLITE_BUSY, "Another program"},
                                       {SQLITE_LOCKED, "Another program"},
                                       {SQLITE_NOMEM, "Check the disk and the file's permissions"}})
        CHECK_THROWS_WITH(throw_record_error("the file", "writing", SQLite::Exception("reason", code)),
                          Contains("the file: writing failed: reason. ") && Contains(remedy));
}

TEST_CASE("tables of sessions whose stimuli were of fewer lists get a column for each that came later",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name;
    create_session_file(file, example_header());
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec(
        "CREATE TABLE early (object INTEGER, material INTEGER, light INTEGER); INSERT INTO early "
        "VALUES (1, 1, 1); "
        "CREATE TABLE earliest (object INTEGER, material INTEGER); "
        "CREATE TABLE of_objects (object INTEGER); CREATE TABLE of_materials (material INTEGER); "
        "ALTER TABLE flip DROP COLUMN step; ALTER TABLE step DROP COLUMN places; DROP TABLE slot; "
        "DROP TABLE missed_refresh; DROP TABLE given_answer; DROP TABLE shown_probe; DROP TABLE swap_modes");
    complete_session_tables(database);
    complete_session_tables(database); // once more changes nothing
    const auto columns = [&](const std::string& table) {
        std::string names;
        SQLite::Statement row(database, "SELECT name FROM pragma_table_info('" + table + "')");
        while (row.executeStep())
            names += row.getColumn(0).getString() + " ";
        return names;
    };
    CHECK(columns("early") == "object material light motion view background ");
    CHECK(database.execAndGet("SELECT light || motion || view || background FROM early").getString() ==
          "1000");
    CHECK(columns("earliest") == "object material light motion view background ");
    CHECK(columns("of_objects") == "object ");
    CHECK(columns("of_materials") == "material ");
    CHECK(columns("missed_refresh") ==
          "trial_id refresh_in_trial refresh planned shown pose vertical_blank_ns "
          "uncertainty_ns ");
    CHECK(columns("swap_modes") == "trial_id flipped copied suboptimal_copied skipped ");
    CHECK(columns("given_answer").starts_with("trial_id n id item kind is_missed "));
    CHECK(columns("shown_probe").starts_with("trial_id "));
    CHECK(columns("slot") == "slot id title left_px top_px width_px height_px ");
    CHECK_THAT(columns("flip"), Contains(" step "));
    CHECK_THAT(columns("step"), Contains(" places "));
}

TEST_CASE("what lies where SQLite's own files may be is a file of the session's folder, or nothing is read",
          "[unit]") {
    for (const char* const name : {"-wal", "-shm", "-journal", ""}) {
        CAPTURE(name);
        const TemporaryFolder root, elsewhere;
        const fs::path file = root.path() / session_file_name;
        create_session_file(file, example_header());
        CHECK_NOTHROW(open_session_file(file, SessionFileUse::read));
        const fs::path target = elsewhere.path() / "a";
        if (std::string(name).empty())
            fs::rename(file, target);
        else
            std::ofstream(target) << "x";
        fs::create_symlink(target, file.string() + name);
        for (const SessionFileUse use :
             {SessionFileUse::read, SessionFileUse::as_it_is, SessionFileUse::write})
            CHECK_THROWS_WITH(open_session_file(file, use),
                              Contains(session_file_name + std::string(name)) &&
                                  Contains("Nothing outside of a session's folder"));
    }
    const TemporaryFolder root;
    CHECK_THROWS_AS(open_session_file(root.path() / "none", SessionFileUse::read), InputError);
    CHECK_THROWS_AS(open_session_file(root.path() / "none", SessionFileUse::write), RecordError);
}

TEST_CASE("a log is folded as soon as whoever reads the file is done, or not within the patience", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name;
    create_session_file(file, example_header());
    SQLite::Database database = open_session_file(file, SessionFileUse::write);
    database.exec("PRAGMA journal_mode = WAL");
    database.exec("INSERT INTO block VALUES (0, 'one')");
    std::optional<SQLite::Database> reader(open_session_file(file, SessionFileUse::read));
    std::optional<SQLite::Statement> rows(std::in_place, *reader, "SELECT id FROM block");
    REQUIRE(rows->executeStep());
    CHECK_FALSE(fold_log(database, std::chrono::milliseconds(0)));
    CHECK_FALSE(fold_log(database, std::chrono::milliseconds(20)));
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        rows.reset();
        reader.reset();
    });
    CHECK(fold_log(database, std::chrono::seconds(20)));
    later.join();
}

TEST_CASE("a file of before its tables had today's names is read by these, and looked at as it is by its own",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / session_file_name;
    create_session_file(file, example_header());
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("ALTER TABLE object RENAME TO sculpture");
    const auto has_objects = [&](SessionFileUse use) {
        SQLite::Database database = open_session_file(file, use);
        return database.tryExec("SELECT COUNT(*) FROM object") == SQLITE_OK;
    };
    CHECK_FALSE(has_objects(SessionFileUse::read)); // of a format that has them, nothing else is meant
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 1");
    CHECK(has_objects(SessionFileUse::read));
    CHECK_FALSE(has_objects(SessionFileUse::as_it_is));
}
