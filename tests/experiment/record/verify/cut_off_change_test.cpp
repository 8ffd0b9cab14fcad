#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

/// Begins to change the file past the log, as closing a session does, and is killed before it has ended.
void change_and_be_killed(const fs::path& session_file) {
    const pid_t child = ::fork();
    if (child == 0) {
        SQLite::Database database(session_file.string(), SQLite::OPEN_READWRITE);
        // Changed pages go to the file at once.
        database.exec(
            "PRAGMA cache_size = 1; PRAGMA cache_spill = 1; BEGIN; UPDATE sample SET pupil_area = 7; "
            "UPDATE flip SET missed = 9");
        ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
}

} // namespace

TEST_CASE("a change of the session's file that a kill cut off is taken back by the first who reads it",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    const AllRows before = read_all_rows(session / session_file_name).value();
    change_and_be_killed(session / session_file_name);
    const fs::path journal = session / (std::string(session_file_name) + "-journal");
    REQUIRE(fs::file_size(journal) > 512);
    REQUIRE_FALSE(read_all_rows(session / session_file_name));
    SECTION("a reader") { CHECK(SessionRecord(session).trials().size() == 3); }
    SECTION("verify") { CHECK(verify_session(session).is_sound()); }
    CHECK_FALSE(fs::exists(journal));
    CHECK(read_all_rows(session / session_file_name) == before);
    CHECK(verify_session(session).is_sound());
}
