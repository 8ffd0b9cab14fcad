#include "experiment/record/schema_migration.h"

#include "experiment/record/read/session_record.h"
#include "experiment/record/verify/verification.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/experiment/record/earlier_session.h"
#include "tests/experiment/record/sealed_session.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

int version_of(const fs::path& file) {
    SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
    return database.execAndGet("PRAGMA user_version").getInt();
}

/// Two trials, a third that failed and is to come again, a fourth that was cut off.
fs::path make_session_of_version(const fs::path& root, int version) {
    fs::path session = make_session(root, example_header());
    const std::vector<Trial> trials = example_header().schedule.trials;
    {
        SessionStore store(session / session_file_name, patient());
        for (std::size_t i = 0; i < 3; ++i) {
            write_rows(store, trials[i], 50);
            TrialOutcome outcome = outcome_at(static_cast<int>(i) * 10000);
            outcome.status = i == 2 ? TrialOutcome::Status::aborted : TrialOutcome::Status::completed;
            if (i == 2)
                store.event(
                    {at_ms(24000), 2, "trial failed",
                     "gaze lost (0 refreshes missed, 40.0 % of samples without gaze): comes again at the "
                     "end of the block"});
            store.trial_finished(trials[i], outcome);
        }
        store.trial_started(trials[3], at_ms(30000));
    }
    make_earlier(session / session_file_name, version);
    return session;
}

} // namespace

TEST_CASE("sessions of earlier formats are read as they are, and nothing in them changes", "[unit]") {
    const int version = GENERATE(1, 2, 3);
    const TemporaryFolder root;
    const fs::path session = make_session_of_version(root.path(), version);
    if (version >= first_version_with_seals)
        begin_manifest(session, example_header(), test_program);
    const std::string before = text_of(session / session_file_name);
    const SessionRecord record(session);
    CHECK(record.header().schedule.trials == example_header().schedule.trials);
    REQUIRE(record.trials().size() == 4);
    CHECK(record.trials()[0].counts);
    CHECK_FALSE(record.trials()[2].counts);
    CHECK(record.trials()[3].status == TrialRecord::Status::open);
    CHECK(record.samples(record.trials()[0]).size() == 50);
    CHECK(record.skipped_trials().empty());
    const Verification found = verify_session(session);
    CHECK(found.is_sound());
    if (version < first_version_with_seals)
        CHECK_THAT(found.notes.at(0), Contains("without seals"));
    else
        CHECK(found.seals > 0);
    CHECK(text_of(session / session_file_name) == before);
}

TEST_CASE("a session of an earlier format that goes on becomes one of today, and a copy is kept", "[unit]") {
    const int version = GENERATE(1, 2, 3);
    const TemporaryFolder root;
    const fs::path session = make_session_of_version(root.path(), version);
    const std::string before = text_of(session / session_file_name);
    const AllRows rows_before = read_all_rows(session / session_file_name).value();
    {
        SessionStore store(session / session_file_name, patient());
        write_rows(store, example_header().schedule.trials[3], 20);
        store.trial_finished(example_header().schedule.trials[3], outcome_at(40000));
        store.close();
    }
    begin_manifest(session, example_header(), test_program);
    REQUIRE(close_manifest(session));
    CHECK(version_of(session / session_file_name) == session_schema_version);
    const fs::path copy = session / ("session.version-" + std::to_string(version) + ".sqlite");
    CHECK(text_of(copy) == before);
    const AllRows rows = read_all_rows(session / session_file_name).value();
    for (const char* const table : {"flip", "sample"})
        for (std::int64_t trial = 1; trial <= 3; ++trial)
            if (version >= 2 || std::string(table) == "sample") {
                // A flip says in which step it was, besides: in that of the only show.
                auto expected = rows_before.at({table, trial});
                for (std::string& row : expected)
                    row += std::string(table) == "flip" ? "1:0|" : "";
                CHECK(rows.at({table, trial}) == expected);
            }

    const SessionRecord record(session);
    REQUIRE(record.trials().size() == 5);
    if (version < 3) // which told it in words
        CHECK(record.trials()[2].outcome.afterwards == TrialOutcome::Afterwards::end_of_block);
    CHECK(record.trials()[3].status == TrialRecord::Status::interrupted);
    CHECK(record.trials()[4].counts);
    const Verification found = verify_session(session);
    for (const Damage& damage : found.damages)
        UNSCOPED_INFO(to_text(damage));
    CHECK(found.is_sound());
    // What was there before is sealed now.
    SQLite::Database(((session / session_file_name).string()), SQLite::OPEN_READWRITE)
        .exec("UPDATE sample SET pupil_area = 1 WHERE trial_id = 1 AND n = 7");
    CHECK(verify_session(session).damages.at(0).row == "trial_id = 1, n = 7");
}

TEST_CASE("seals that an earlier format set hold after tables and columns have other names", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session_of_version(root.path(), 3);
    REQUIRE(migrate_session_file(session / session_file_name));
    const auto damages = [&] { return verify_session(session).damages; };
    const auto spoil = [&](const char* sql) {
        SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
    };
    const auto is_told = [&](const std::string& table) {
        const auto found = damages();
        return std::ranges::any_of(found, [&](const Damage& damage) { return damage.table == table; });
    };
    CHECK_FALSE(is_told("trial"));
    CHECK_FALSE(is_told("sculpture"));
    spoil("UPDATE trial SET object = object + 1 WHERE trial_id = 2");
    CHECK(is_told("trial"));
    spoil("UPDATE object SET title = title || '!'");
    CHECK(is_told("sculpture"));
}

TEST_CASE("of a trial that failed twice each attempt gets what was decided about itself", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    const Trial trial = example_header().schedule.trials[2];
    {
        SessionStore store(session / session_file_name, patient());
        const char* const decided[] = {"gaze lost: comes again now",
                                       "gaze lost: comes again at the end of the block",
                                       "gaze lost: it does not come again"};
        for (int attempt = 0; attempt < 3; ++attempt) {
            const int start_ms = 10'000 * (attempt + 1);
            store.trial_started(trial, at_ms(start_ms));
            TrialOutcome outcome = outcome_at(start_ms);
            outcome.status = TrialOutcome::Status::aborted;
            store.event({at_ms(start_ms + 4500), 2, "trial failed", decided[attempt]});
            store.trial_finished(trial, outcome);
        }
    }
    make_earlier(session / session_file_name, 2);
    SessionStore(session / session_file_name, patient()).close();
    const SessionRecord record(session);
    REQUIRE(record.trials().size() == 3);
    CHECK(record.trials()[0].outcome.afterwards == TrialOutcome::Afterwards::now);
    CHECK(record.trials()[1].outcome.afterwards == TrialOutcome::Afterwards::end_of_block);
    CHECK(record.trials()[2].outcome.afterwards == TrialOutcome::Afterwards::never);
}

TEST_CASE("a session of today needs no migration, and one of tomorrow is refused by its version", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    const std::string before = text_of(session / session_file_name);
    CHECK_FALSE(migrate_session_file(session / session_file_name));
    CHECK(text_of(session / session_file_name) == before);
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE)
        .exec("PRAGMA user_version = 99");
    CHECK_THROWS_WITH(migrate_session_file(session / session_file_name),
                      Contains("newer overt") && Contains("99"));
}

TEST_CASE("a migration that cannot keep a copy changes nothing", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session_of_version(root.path(), 2);
    const std::string before = text_of(session / session_file_name);
    // Where the copy would go first, something else is.
    fs::create_directories(session / "session.version-2.sqlite.partial");
    CHECK_THROWS_WITH(SessionStore(session / session_file_name, patient()),
                      Contains("session.version-2.sqlite") && Contains("the session is as it was"));
    CHECK(text_of(session / session_file_name) == before);
}
