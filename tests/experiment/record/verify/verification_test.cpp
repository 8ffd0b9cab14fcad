#include "experiment/record/verify/verification.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

bool names_file(const Verification& found, const std::string& file) {
    return std::any_of(found.damages.begin(), found.damages.end(),
                       [&](const Damage& damage) { return damage.file == file; });
}

std::string words(const Verification& found) {
    std::string text;
    for (const Damage& damage : found.damages)
        text += to_text(damage) + "\n";
    return text;
}

/// Where the rows of one trial and table alone are others, verify must say just so, and which row it is.
/// Whether that was to be checked.
bool check_it_is_named(const Verification& found, const AllRows& before,
                       const std::optional<AllRows>& after) {
    if (!after)
        return false;
    const auto places = differing(before, *after);
    if (places.size() != 1)
        return false;
    const std::string& table = places.begin()->first;
    const std::int64_t trial_id = places.begin()->second;
    if (table == "seal" || table == "sealed_table")
        return false;
    const auto named = std::find_if(found.damages.begin(), found.damages.end(), [&](const Damage& damage) {
        return damage.table == table && damage.trial_id.value_or(0) == trial_id;
    });
    CHECK(named != found.damages.end());
    const auto now = after->find(*places.begin()), then = before.find(*places.begin());
    if (now != after->end() && then != before.end() && now->second.size() == then->second.size() &&
        named != found.damages.end())
        CHECK_FALSE(named->row.empty());
    return true;
}

} // namespace

TEST_CASE("sessions as they were written are sound, closed ones and those that were cut off", "[unit]") {
    const TemporaryFolder root;
    const fs::path closed = make_whole_session(root.path());
    CHECK(verify_session(closed).is_sound()); // before its first sitting, too
    write_whole_session(closed);
    const Verification one = verify_session(closed);
    INFO(words(one));
    CHECK(one.is_sound());
    CHECK(one.state == Verification::State::closed);
    CHECK(one.files == 5);
    CHECK(one.notes == std::vector<std::string>{});
    const fs::path killed = make_whole_session(root.path());
    write_killed_session(killed);
    const Verification other = verify_session(killed);
    INFO(words(other));
    CHECK(other.is_sound());
    CHECK(other.state == Verification::State::interrupted);
    REQUIRE(other.notes.size() == 1);
    CHECK_THAT(other.notes[0], Contains("rows are not sealed yet"));
    {
        SessionStore store(killed / session_file_name, patient());
        const Verification running = verify_session(killed);
        INFO(words(running));
        CHECK(running.is_sound());
        CHECK(running.state == Verification::State::running);
        store.close();
    }
    REQUIRE(close_manifest(killed));
    const Verification resumed = verify_session(killed);
    INFO(words(resumed));
    CHECK(resumed.is_sound());
    CHECK(resumed.state == Verification::State::closed);
    CHECK_THROWS_AS(verify_session(root.path()), InputError);
    CHECK_THROWS_AS(verify_session(root.path() / "nowhere"), InputError);
}

TEST_CASE("one bit turned over anywhere in a closed session is found, with its file, its trial and its row",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    const AllRows before = read_all_rows(session / session_file_name).value();
    std::vector<std::string> files = files_of_session(session, true);
    files.emplace_back(manifest_file_name);
    RandomStream random(1, "flips");
    int in_rows = 0;
    for (int round = 0; round < 400; ++round) {
        // Half of them in the rows.
        const std::string file = round % 2 == 0
                                     ? std::string(session_file_name)
                                     : files[random.below(static_cast<std::uint32_t>(files.size()))];
        const auto size = static_cast<std::uint32_t>(fs::file_size(session / file));
        const std::uint32_t byte = random.below(size), bit = random.below(8);
        const FlippedBit flipped(session / file, byte, static_cast<int>(bit));
        const Verification found = verify_session(session);
        INFO(file << ", byte " << byte << ", bit " << bit << "\n" << words(found));
        REQUIRE_FALSE(found.is_sound());
        REQUIRE(names_file(found, file));
        if (file == session_file_name)
            in_rows += check_it_is_named(found, before, read_all_rows(session / session_file_name));
        else
            CHECK(found.damages.size() == 1);
    }
    CHECK(in_rows > 15);
    CHECK(verify_session(session).is_sound());
}

TEST_CASE("one bit turned over anywhere in a session that was cut off is found, with its file", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_killed_session(session);
    const AllRows before = read_all_rows(session / session_file_name).value();
    const std::string log = std::string(session_file_name) + "-wal";
    REQUIRE(fs::file_size(session / log) > 10'000);
    std::vector<std::string> files = files_of_session(session, false);
    files.emplace_back(manifest_file_name);
    REQUIRE(files.size() == 5); // protocol, mesh, map and preview of a frame
    RandomStream random(2, "flips");
    int between_rows = 0, in_rows = 0;
    for (std::size_t round = 0; round < 300; ++round) {
        const std::string file = round % 3 == 0   ? std::string(session_file_name)
                                 : round % 3 == 1 ? log
                                                  : files[round / 3 % files.size()];
        const auto size = static_cast<std::uint32_t>(fs::file_size(session / file));
        const std::uint32_t byte = random.below(size), bit = random.below(8);
        const FlippedBit flipped(session / file, byte, static_cast<int>(bit));
        const Verification found = verify_session(session);
        INFO(file << ", byte " << byte << ", bit " << bit << "\n" << words(found));
        if (file != session_file_name) {
            REQUIRE_FALSE(found.is_sound());
            CHECK(names_file(found, file));
            continue;
        }
        // Bytes that no row is in are covered, too.
        REQUIRE_FALSE(found.is_sound());
        CHECK(names_file(found, file));
        const std::optional<AllRows> after = read_all_rows(session / session_file_name);
        between_rows += after && differing(before, *after).empty();
        in_rows += check_it_is_named(found, before, after);
    }
    CHECK(between_rows > 20);
    CHECK(in_rows > 2);
    CHECK(verify_session(session).is_sound());
}

TEST_CASE("files that are missing or shortened are damage, files that were added are noted", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    fs::create_directories(session / "export_tsv");
    std::ofstream(session / "export_tsv/a.tsv") << "a";
    std::ofstream(session / "remark.txt") << "a";
    Verification found = verify_session(session);
    CHECK(found.is_sound());
    REQUIRE(found.notes.size() == 1);
    CHECK_THAT(found.notes[0], Contains("remark.txt"));
    fs::resize_file(session / "stimuli/a.png", 10);
    fs::remove(session / "meshes/bust.ply");
    found = verify_session(session);
    CHECK(found.damages.size() == 2);
    CHECK(names_file(found, "meshes/bust.ply"));
    CHECK(names_file(found, "stimuli/a.png"));
    fs::remove(session / manifest_file_name);
    CHECK(names_file(verify_session(session), manifest_file_name));
}

TEST_CASE("a file that came in part is fetched again after the session, which is sound before and after",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    begin_manifest(session, example_header(), test_program);
    std::ofstream(session / "P01A.edf.part") << "half";
    write_whole_session(session);
    CHECK(verify_session(session).is_sound());
    fs::rename(session / "P01A.edf.part", session / "P01A.edf");
    std::ofstream(session / "P01A.edf") << "half, and the other";
    CHECK(verify_session(session).is_sound());
}

TEST_CASE("a session of a newer program is not taken for a damaged one", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE)
        .exec("PRAGMA user_version = 99");
    // Until the manifest says that the file was written so, it is a change.
    Verification found = verify_session(session);
    CHECK(names_file(found, session_file_name));
    CHECK(found.state == Verification::State::closed);
    CHECK_THAT(words(found), Contains("is not as it was when the session ended") && Contains("newer overt"));
    reopen_manifest(session, example_header(), test_program);
    REQUIRE(close_manifest(session));
    CHECK_THROWS_AS(verify_session(session), InputError);
    CHECK_THROWS_WITH(verify_session(session), Contains("newer overt") && Contains("99"));
    fs::resize_file(session / "stimuli/a.png", 10);
    found = verify_session(session);
    CHECK(names_file(found, "stimuli/a.png"));
    CHECK(found.state == Verification::State::closed);
}

TEST_CASE("rows that are changed, added or taken away through SQL are found", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    const char* const sql = GENERATE(
        "UPDATE sample SET x_px = 7 WHERE trial_id = 2 AND n = 123",
        "DELETE FROM flip WHERE trial_id = 3 AND n = 1",
        "INSERT INTO missed_refresh VALUES (2, 1, 1, 1, 1, 1, 1, 1)",
        "UPDATE event SET detail = 'x' WHERE id = 2", "DELETE FROM event WHERE id = 4",
        "UPDATE trial SET answer = 'x' WHERE trial_id = 1", "UPDATE schedule SET task = 0 WHERE trial = 0",
        "UPDATE session SET observer_label = 'Z'",
        "DELETE FROM seal WHERE seal = (SELECT MAX(seal) FROM seal)",
        "UPDATE seal SET sitting = 9 WHERE seal = 3", "INSERT INTO event VALUES (99, 1, 1, 1, 'a', 'b')",
        "INSERT INTO superseded VALUES (1, 1, 'x')", "CREATE TABLE other (a)",
        "UPDATE map SET sha256 = 'x' WHERE pose = 0", "DROP TABLE part");
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
    const Verification found = verify_session(session);
    INFO(sql << "\n" << words(found));
    // Not by the file's hash alone.
    CHECK(std::any_of(found.damages.begin(), found.damages.end(),
                      [](const Damage& damage) { return !damage.table.empty(); }));
    if (std::string(sql).starts_with("UPDATE sample")) {
        CHECK(found.damages[0].trial == 1);
        CHECK(found.damages[0].row == "trial_id = 2, n = 123");
    }
}

TEST_CASE("a log that another program folded is no damage, and rows are looked at all the same", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_killed_session(session);
    const auto open_as_anybody = [&](const std::string& what) {
        SQLite::Database(session / session_file_name, SQLite::OPEN_READWRITE).exec(what);
    };
    open_as_anybody("SELECT 1 FROM trial"); // the last to close it folds it
    REQUIRE_FALSE(fs::exists(session / (std::string(session_file_name) + "-wal")));
    for (int round = 0; round < 2; ++round) { // looking makes an empty log, which changes nothing
        const Verification found = verify_session(session);
        INFO(words(found));
        CHECK(found.is_sound());
        CHECK(found.state == Verification::State::interrupted);
        REQUIRE_FALSE(found.notes.empty());
        CHECK_THAT(found.notes[0], Contains("another program has folded its log"));
    }
    open_as_anybody("UPDATE sample SET pupil_area = pupil_area + 1 WHERE trial_id = 1 AND n = 0");
    CHECK_FALSE(verify_session(session).is_sound());
}

TEST_CASE("what is said of damage is text, whatever the damaged bytes are", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_whole_session(root.path());
    write_whole_session(session);
    SQLite::Database(session / session_file_name, SQLite::OPEN_READWRITE)
        .exec("UPDATE sealed_table SET name = name || CAST(x'e4' AS TEXT) WHERE name = 'flip'");
    const Verification found = verify_session(session);
    CHECK_FALSE(found.is_sound());
    CHECK_THAT(words(found), Contains("the table is gone"));
    CHECK(is_utf8(words(found)));
}

TEST_CASE("the file of another session in a folder is found, though all its rows are sealed", "[unit]") {
    for (const bool is_closed : {false, true}) {
        const TemporaryFolder root;
        const fs::path session = make_whole_session(root.path());
        SessionHeader other = example_header();
        ++other.session_number;
        begin_manifest(session, other, test_program);
        if (is_closed)
            write_whole_session(session);
        else
            write_killed_session(session);
        const Verification found = verify_session(session);
        INFO(words(found));
        CHECK(found.damages.size() == 1);
        CHECK_THAT(words(found), Contains("session.sqlite: is that of another session: of") &&
                                     Contains("session 3, and the manifest is of") && Contains("session 4"));
    }
}
