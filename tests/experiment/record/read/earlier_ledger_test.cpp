#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/missed_rows.h"

using namespace overt;
using namespace overt::testing;

namespace {

FlipRecord flip_at(int refresh) {
    FlipRecord flip{0, refresh, {0}, {1}, {2}, {}};
    flip.report.vertical_blank = at_ms(100 + 10 * refresh);
    flip.report.uncertainty = std::chrono::microseconds(7);
    return flip;
}

void write_some(const std::filesystem::path& session, int first) {
    SessionStore store(session / session_file_name, patient());
    store.trial_started(example_header().schedule.trials[0], at_ms(0));
    for (int refresh = first; refresh < first + 3; ++refresh)
        store.flip(flip_at(refresh));
    store.missed({0, first + 3, {1000}, {2}, {1}, {0}, at_ms(500), std::chrono::microseconds(9)});
    store.trial_finished(example_header().schedule.trials[0], outcome_at(0));
    store.close();
}

} // namespace

TEST_CASE("what the ledger says of flips and misses is read as it was written", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = example_header();
    header.animations[0].when_late = WhenLate::stretch;
    const auto session = make_session(root.path(), header);
    write_some(session, 0);
    const SessionRecord record(session);
    CHECK(record.header().animations[0].when_late == WhenLate::stretch);
    REQUIRE(record.trials().size() == 1);
    for (const FlipRecord& flip : record.flips(record.trials()[0]))
        CHECK(flip.report.uncertainty == std::chrono::microseconds(7));
    const std::vector<MissedRefresh> missed = test::missed_rows(session, record.trials()[0].id);
    REQUIRE(missed.size() == 1);
    CHECK(missed[0] == MissedRefresh{0, 3, {1000}, {2}, {1}, {0}, at_ms(500), std::chrono::microseconds(9)});
}

TEST_CASE("a session begun before misses had rows is read, and goes on with them", "[unit]") {
    const TemporaryFolder root;
    const auto session = make_session(root.path(), example_header());
    write_some(session, 0);
    {
        SQLite::Database database((session / session_file_name).string(), SQLite::OPEN_READWRITE);
        database.exec("DROP TABLE missed_refresh; ALTER TABLE flip DROP COLUMN uncertainty_ns; "
                      "ALTER TABLE session DROP COLUMN when_late; PRAGMA user_version = 2");
    }
    {
        const SessionRecord record(session);
        CHECK(record.header().animations[0].when_late == WhenLate::drop);
        CHECK(record.flips(record.trials()[0]).size() == 3);
        CHECK(record.flips(record.trials()[0])[0].report.uncertainty == SessionDuration::zero());
        CHECK(test::missed_rows(session, record.trials()[0].id).empty());
    }
    write_some(session, 0);
    const SessionRecord record(session);
    REQUIRE(record.trials().size() == 2);
    CHECK(record.flips(record.trials()[1])[0].report.uncertainty == std::chrono::microseconds(7));
    CHECK(test::missed_rows(session, record.trials()[1].id).size() == 1);
}
