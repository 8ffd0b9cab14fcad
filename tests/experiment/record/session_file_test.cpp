#include "experiment/record/session_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

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
