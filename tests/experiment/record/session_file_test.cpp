#include "experiment/record/session_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
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
