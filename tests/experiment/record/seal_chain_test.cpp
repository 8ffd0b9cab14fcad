#include "experiment/record/seal_chain.h"

#include <set>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/record/sql.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

TableSeal example_line() {
    return {"sample", "trial_id, n, x_px", SealedRows::of_trial, 0, 0, 3, hash_of_text("rows"), "locator"};
}

} // namespace

TEST_CASE("a seal depends on the seal before it and on all that it says", "[unit]") {
    const ContentHash before = hash_of_text("the seal before");
    const TableSeal line = example_line();
    std::set<std::string> seen{seal_hash(before, SealKind::trial, 1, 7, {line})};
    const auto is_new = [&](const ContentHash& hash) { return seen.insert(hash).second; };
    CHECK_FALSE(is_new(seal_hash(before, SealKind::trial, 1, 7, {line})));
    CHECK(is_new(seal_hash(hash_of_text("another"), SealKind::trial, 1, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::other, 1, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 2, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 8, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, std::nullopt, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 7, {})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 7, {line, line})));
    const auto with = [&](auto change) {
        TableSeal other = example_line();
        change(other);
        return seal_hash(before, SealKind::trial, 1, 7, {other});
    };
    CHECK(is_new(with([](TableSeal& s) { s.name = "flip"; })));
    CHECK(is_new(with([](TableSeal& s) { s.columns = "trial_id, n"; })));
    CHECK(is_new(with([](TableSeal& s) { s.rows = SealedRows::all; })));
    CHECK(is_new(with([](TableSeal& s) { s.after_id = 1; })));
    CHECK(is_new(with([](TableSeal& s) { s.to_id = 1; })));
    CHECK(is_new(with([](TableSeal& s) { s.row_count = 4; })));
    CHECK(is_new(with([](TableSeal& s) { s.sha256 = hash_of_text("other rows"); })));
    CHECK(is_new(with([](TableSeal& s) { s.locator = "elsewhere"; })));
}

namespace {

/// What seals say of a table: kind of seal, sitting, trial, covers, after, to, rows.
std::string seals_of(const SQLite::Database& database, const std::string& table) {
    std::string text;
    for (Query row(database,
                   ("SELECT seal.seal, kind, sitting, trial_id, covers, after_id, to_id, row_count FROM "
                    "seal JOIN sealed_table USING (seal) WHERE name = '" +
                    table + "' ORDER BY seal.seal")
                       .c_str());
         row.step();) {
        for (int column = 0; column < 8; ++column)
            text += row.text() + (column < 7 ? "|" : "\n");
    }
    return text;
}

} // namespace

TEST_CASE("each row is sealed once where its table only grows, and anew where rows may change", "[unit]") {
    const TemporaryFolder root;
    const std::string file = (root.path() / "a.sqlite").string();
    create_session_file(file, example_header());
    const auto opened = [&] { return SQLite::Database(file, SQLite::OPEN_READWRITE); };
    const auto event = [](SQLite::Database& database, int sitting) {
        database.exec("INSERT INTO event (sitting, at_ns, kind, detail) VALUES (" + std::to_string(sitting) +
                      ", 0, 'note', '')");
    };
    {
        SQLite::Database database = opened();
        SealWriter writer(database);
        CHECK_FALSE(writer.is_new()); // it was sealed when it was made
        database.exec("INSERT INTO sitting (sitting, started_utc, closed) VALUES (1, '', 0)");
        event(database, 1);
        event(database, 1);
        writer.seal_rest(SealKind::sitting, 1);
        database.exec(
            "INSERT INTO sample VALUES (1, 0, 5, 0, 1, 2, 3), (1, 1, 6, 0, 1, 2, 3), (2, 0, 7, 0, 1, 2, 3)");
        database.exec(
            "INSERT INTO gaze_event (trial_id, n, kind, start_us, end_us, duration_us, text) VALUES "
            "(0, 0, 'message', 0, 0, 0, ''), (-1, 0, 'message', 0, 0, 0, '')");
        event(database, 1);
        writer.seal_trial(1, 1);
        writer.seal_rest(SealKind::other, 1); // nothing new
        database.exec("UPDATE sitting SET closed = 1");
        writer.seal_rest(SealKind::end, 1);
    }
    {
        SQLite::Database database = opened(); // by another program, which takes the chain up
        database.exec("INSERT INTO sitting (sitting, started_utc, closed) VALUES (2, '', 0)");
        event(database, 2);
        SealWriter writer(database);
        writer.seal_rest(SealKind::sitting, 2);
        writer.seal_trial(2, 2);
    }
    const SQLite::Database database = opened();
    CHECK(seals_of(database, "event") ==
          "2|sitting|1||new|0|2|2\n3|trial|1|1|new|2|3|1\n6|sitting|2||new|3|4|1\n");
    CHECK(seals_of(database, "sample") == "3|trial|1|1|trial|1|0|2\n7|trial|2|2|trial|2|0|1\n");
    CHECK(seals_of(database, "gaze_event") ==
          "3|trial|1|1|trial|1|0|0\n4|other|1||no trial|0|0|2\n7|trial|2|2|trial|2|0|0\n");
    CHECK(seals_of(database, "sitting") ==
          "1|beginning|0||all|0|0|0\n2|sitting|1||all|0|0|1\n5|end|1||all|0|0|1\n6|sitting|2||all|0|0|2\n");
    CHECK(seals_of(database, "session") == "1|beginning|0||all|0|0|1\n");
    // Each seal names the one before it.
    std::string last;
    int seals = 0;
    for (Query row(database, "SELECT previous, sha256 FROM seal ORDER BY seal"); row.step(); ++seals) {
        CHECK(row.text() == last);
        last = row.text();
    }
    CHECK(seals == 7);
    {
        SQLite::Database again = opened();
        again.exec("INSERT INTO trial (trial_id, sitting, trial, attempt, task, object, material, status, "
                   "started_ns) "
                   "VALUES (1, 1, 0, 1, 0, 0, 0, 'completed', 0), (2, 2, 1, 1, 0, 0, 0, 'open', 0)");
        seal_all_anew(again);
    }
    // All at once, and the trials that have ended one by one.
    CHECK(seals_of(database, "event") == "1|beginning|2||new|0|4|4\n");
    CHECK(seals_of(database, "sample") == "2|trial|2|1|trial|1|0|2\n");
}
