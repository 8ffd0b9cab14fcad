#include "experiment/record/write/session_store.h"

#include <memory>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/store_rows.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("rows, outcomes, events and clock pairs come back as they were written", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header);
    const ClockPair pair{at_ms(1), TrackerTime(std::chrono::microseconds(77)), at_ms(2)};
    TrialOutcome broken_off = outcome_at(10000);
    broken_off.status = TrialOutcome::Status::aborted;
    broken_off.drift.reset();
    {
        SessionStore store(session / session_file_name, patient());
        store.event({at_ms(0), -1, "welcome", ""});
        store.clock_pair(pair);
        write_trial(store, header.schedule.trials[0], 777);
        store.trial_started(header.schedule.trials[1], at_ms(10000));
        store.event({at_ms(10001), 1, "drift check", "left\tright"});
        store.sample(1, sample_number(3));
        store.trial_finished(header.schedule.trials[1], broken_off);
        store.map_made({{1}, {0}, "maps/other.exr", "f", RecordedMap::Made::live});
        store.close();
    }
    const SessionRecord record(session);
    CHECK(record.closed_in_order());
    CHECK(record.damages().empty());
    REQUIRE(record.trials().size() == 2);

    const TrialRecord& first = record.trials()[0];
    CHECK(first.trial == header.schedule.trials[0]);
    CHECK(first.status == TrialRecord::Status::completed);
    CHECK(first.attempt == 1);
    CHECK(first.sitting == 1);
    CHECK(first.started == at_ms(0));
    const TrialOutcome expected = outcome_at(0);
    CHECK(first.outcome.status == expected.status);
    CHECK(first.outcome.task_screen_onset == expected.task_screen_onset);
    CHECK(first.outcome.presentation_onset == expected.presentation_onset);
    CHECK(first.outcome.presentation_end == expected.presentation_end);
    CHECK(first.outcome.response_screen_onset == expected.response_screen_onset);
    CHECK(first.outcome.responded_at == expected.responded_at);
    CHECK(first.outcome.shown_refreshes == expected.shown_refreshes);
    CHECK(first.outcome.missed_refreshes == expected.missed_refreshes);
    CHECK(first.outcome.swaps == expected.swaps);
    CHECK(first.outcome.drift == expected.drift);
    CHECK(first.outcome.answer == expected.answer);
    CHECK(first.lost_flips == 0);
    CHECK(first.lost_samples == 0);
    const auto samples = record.samples(first);
    REQUIRE(samples.size() == 777);
    for (int i = 0; i < 777; ++i)
        require_same(samples[static_cast<std::size_t>(i)], sample_number(i));
    const auto flips = record.flips(first);
    REQUIRE(flips.size() == 39);
    for (int i = 0; i < 39; ++i)
        require_same(flips[static_cast<std::size_t>(i)], flip_number(0, i));

    const TrialRecord& second = record.trials()[1];
    CHECK(second.status == TrialRecord::Status::aborted);
    CHECK_FALSE(second.outcome.drift);
    CHECK(record.samples(second).size() == 1);
    CHECK(record.flips(second).empty());

    const auto events = record.events();
    REQUIRE(events.size() == 2);
    CHECK(events[0].trial == -1);
    CHECK(events[0].kind == "welcome");
    CHECK(events[1].at == at_ms(10001));
    CHECK(events[1].trial == 1);
    CHECK(events[1].detail == "left\tright");
    REQUIRE(record.clock_pairs(1).size() == 1);
    CHECK(record.clock_pairs(1)[0].before == pair.before);
    CHECK(record.clock_pairs(1)[0].other == pair.other);
    CHECK(record.clock_pairs(1)[0].after == pair.after);
    CHECK(record.header().maps[1].file == "maps/other.exr");
    CHECK(record.last_time() == flips.back().report.vertical_blank);
}

TEST_CASE("a closed session is one file, and a read-only folder does not hinder its readers", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    SessionStore store(session / session_file_name, patient());
    write_trial(store, example_header().schedule.trials[0]);
    store.close();
    CHECK(std::distance(fs::directory_iterator(session), fs::directory_iterator()) == 1);
    fs::permissions(session, fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(SessionRecord(session).trials().size() == 1);
    fs::permissions(session, fs::perms::owner_all);
}

TEST_CASE("a session that is read while it ends is one file as soon as nobody reads", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    SessionStore store(session / session_file_name, patient());
    write_trial(store, example_header().schedule.trials[0]);
    auto record = std::make_unique<const SessionRecord>(session);
    std::thread reader([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        record.reset();
    });
    store.close();
    reader.join();
    CHECK_FALSE(fs::exists(session / (std::string(session_file_name) + "-wal")));
    CHECK(SessionRecord(session).trials().size() == 1);
}

TEST_CASE("a session that somebody keeps open keeps its log, and is folded once it is let go", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    const fs::path file = session / session_file_name, log = file.string() + "-wal";
    SessionStore store(file, patient());
    write_trial(store, example_header().schedule.trials[0]);
    {
        const SessionRecord reader(session);
        store.close();
        CHECK(fs::exists(log));
        CHECK(reader.trials().size() == 1);
        SQLite::Database database = open_session_file(file, SessionFileUse::write);
        CHECK_FALSE(fold_log(database, std::chrono::milliseconds(20)));
    }
    CHECK(SessionRecord(session).trials().size() == 1);
    CHECK(fold_session_file(file));
    CHECK_FALSE(fs::exists(log));
    CHECK(SessionRecord(session).trials().size() == 1);
}

TEST_CASE("rows of a running trial can be read before it ends", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header);
    SessionStore store(session / session_file_name, patient());
    store.trial_started(header.schedule.trials[0], at_ms(0));
    for (int i = 0; i < 100; ++i)
        store.sample(0, sample_number(i));
    std::size_t seen = 0;
    for (int look = 0; look < 500 && seen == 0; ++look) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const SessionRecord record(session);
        seen = record.trials().empty() ? 0 : record.samples(record.trials()[0]).size();
    }
    CHECK(seen == 100);
}

TEST_CASE("one session cannot be run twice at the same time", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    const SessionStore store(session / session_file_name, patient());
    CHECK_THROWS_WITH(SessionStore(session / session_file_name, patient()), Contains("another program"));
}

TEST_CASE("a marker whose fate is known late belongs to the attempt in which it was set", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    create_session_file(root.path() / session_file_name, header);
    const auto marker_at = [](int trial, SessionTime at) {
        RecordedMarker marker;
        marker.trial = trial;
        marker.at = at;
        marker.output = "eeg";
        marker.text = "TRIAL_RESULT";
        return marker;
    };
    {
        SessionStore store(root.path() / session_file_name, patient());
        TrialOutcome broken_off = outcome_at(0);
        broken_off.status = TrialOutcome::Status::aborted;
        store.trial_started(header.schedule.trials[0], at_ms(0));
        store.trial_finished(header.schedule.trials[0], broken_off);
        store.trial_started(header.schedule.trials[0], at_ms(1000)); // again
        store.trial_finished(header.schedule.trials[0], outcome_at(0));
        store.trial_started(header.schedule.trials[1], at_ms(2000));
        store.markers({marker_at(0, at_ms(999)), marker_at(0, at_ms(1999)), marker_at(1, at_ms(2001)),
                       marker_at(2, at_ms(2001)), marker_at(-1, at_ms(2001))});
        store.trial_finished(header.schedule.trials[1], outcome_at(0));
        store.close();
    }
    const SessionRecord record(root.path());
    REQUIRE(record.trials().size() == 3);
    const std::vector<RecordedMarker> markers = record.markers();
    REQUIRE(markers.size() == 5);
    CHECK(markers[0].attempt_id == record.trials()[0].id);
    CHECK(markers[1].attempt_id == record.trials()[1].id);
    CHECK(markers[2].attempt_id == record.trials()[2].id);
    CHECK_FALSE(markers[3].attempt_id); // no such attempt
    CHECK_FALSE(markers[4].attempt_id);
}
