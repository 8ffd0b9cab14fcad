/// What was imported is sealed as what was recorded: a changed byte is found and named.
#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/experiment/record/sealed_session.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

AscImportOptions import_options(const fs::path& out) {
    AscImportOptions options;
    options.place = {out.parent_path() / "sessions", "imported", "07"};
    options.out = out;
    options.now_utc = "2026-01-01T00:00:00Z";
    return options;
}

fs::path import_example(const test::TemporaryFolder& root) {
    AscExample example;
    example.samples = 400;
    const fs::path file = write_asc(root.path() / "recording.asc", asc_text(example));
    return import_asc(file, import_options(root.path() / "imported")).session;
}

/// A copy of a session with the gaze of its own export.
fs::path import_into_copy(const test::TemporaryFolder& root) {
    const fs::path session = make_eye_session(root.path());
    export_asc(SessionRecord(session), root.path() / "asc");
    return import_asc_into(root.path() / "asc" / "sub-AB7_ses-01_run-01.asc", session,
                           import_options(root.path() / "with_gaze"))
        .session;
}

} // namespace

TEST_CASE(
    "one bit turned over in an imported session, or in a copy with imported gaze, is found with its file",
    "[unit]") {
    const test::TemporaryFolder root;
    const bool is_copy = GENERATE(false, true);
    const fs::path session = is_copy ? import_into_copy(root) : import_example(root);
    CAPTURE(is_copy);
    REQUIRE(verify_session(session).is_sound());
    REQUIRE(verify_session(session).seals > 2);
    std::vector<std::string> files = files_of_session(session, true);
    files.emplace_back(manifest_file_name);
    REQUIRE(files.size() == (is_copy ? 5 : 2));
    RandomStream random(7, "flips");
    for (std::size_t round = 0; round < 150; ++round) {
        const std::string file =
            round % 3 < 2 ? std::string(session_file_name) : files[round / 3 % files.size()];
        const auto size = static_cast<std::uint32_t>(fs::file_size(session / file));
        const std::uint32_t byte = random.below(size), bit = random.below(8);
        const FlippedBit flipped(session / file, byte, static_cast<int>(bit));
        const Verification found = verify_session(session);
        CAPTURE(file, byte, bit);
        REQUIRE_FALSE(found.is_sound());
        CHECK(std::any_of(found.damages.begin(), found.damages.end(),
                          [&](const Damage& damage) { return damage.file == file; }));
    }
    CHECK(verify_session(session).is_sound());
}

TEST_CASE("a changed sample or event of imported gaze is found with its trial and its row", "[unit]") {
    const test::TemporaryFolder root;
    const bool is_copy = GENERATE(false, true);
    const fs::path session = is_copy ? import_into_copy(root) : import_example(root);
    const std::string table = GENERATE("sample", "gaze_event", "gaze_source");
    const std::map<std::string, std::pair<std::string, std::string>> changes{
        {"sample",
         {"UPDATE sample SET x_px = x_px + 0.001 WHERE trial_id = 2 AND n = 61", "trial_id = 2, n = 61"}},
        {"gaze_event",
         {"UPDATE gaze_event SET text = 'x' WHERE trial_id = 1 AND n = 0", "trial_id = 1, n = 0"}},
        {"gaze_source", {"UPDATE gaze_source SET sha256 = 'x'", "sitting = 1"}}};
    const auto& [sql, row] = changes.at(table);
    CAPTURE(is_copy, sql);
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
    const Verification found = verify_session(session);
    REQUIRE_FALSE(found.is_sound());
    CHECK(found.damages[0].table == table);
    CHECK(found.damages[0].row == row);
    if (table == "sample")
        CHECK(found.damages[0].trial == 1);
}
