#include "experiment/record/write/session_store.h"

#include <csignal>

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include "experiment/base/error.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/store_rows.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

TEST_CASE("each row is either kept or counted as lost when the ring overflows", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header);
    constexpr int count = 20'000;
    const bool wait = GENERATE(false, true);
    SessionStore::Options options = patient();
    options.wait_when_full = wait;
    options.ring_capacity = 16;
    LostRows lost;
    {
        SessionStore store(session / session_file_name, options);
        write_trial(store, header.schedule.trials[0], count);
        lost = store.lost();
    }
    const SessionRecord record(session);
    const TrialRecord& trial = record.trials().at(0);
    CHECK(static_cast<std::int64_t>(record.samples(trial).size()) + lost.samples == count);
    CHECK(static_cast<std::int64_t>(record.flips(trial).size()) + lost.flips == count / 20);
    CHECK(trial.lost_samples == lost.samples);
    CHECK(trial.lost_flips == lost.flips);
    CHECK((lost.samples == 0) == wait);
}

TEST_CASE("a session whose program is killed keeps every completed trial, and goes on", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header);
    const int status = in_child([&] {
        SessionStore store(session / session_file_name, patient());
        write_trial(store, header.schedule.trials[0]);
        write_trial(store, header.schedule.trials[1], 30'000);
        store.trial_started(header.schedule.trials[2], at_ms(30000));
        for (int i = 0; i < 5000; ++i)
            store.sample(2, sample_number(i));
        ::raise(SIGKILL);
    });
    REQUIRE(WIFSIGNALED(status));
    {
        const SessionRecord killed(session);
        CHECK(killed.damages().empty());
        CHECK_FALSE(killed.closed_in_order());
        REQUIRE(killed.trials().size() >= 2);
        REQUIRE(killed.trials().size() <= 3);
        CHECK(killed.trials()[0].status == TrialRecord::Status::completed);
        CHECK(killed.trials()[1].status == TrialRecord::Status::completed);
        CHECK(killed.samples(killed.trials()[0]).size() == 1000);
        CHECK(killed.samples(killed.trials()[1]).size() == 30'000);
        CHECK(killed.flips(killed.trials()[1]).size() == 1500);
        if (killed.trials().size() == 3)
            CHECK(killed.trials()[2].status == TrialRecord::Status::open);
    }
    {
        SessionStore store(session / session_file_name, patient());
        write_trial(store, header.schedule.trials[2], 50);
        store.close();
    }
    const SessionRecord resumed(session);
    const TrialRecord& again = resumed.trials().back();
    CHECK(again.sitting == 2);
    CHECK(again.attempt == static_cast<int>(resumed.trials().size()) - 2);
    CHECK(again.status == TrialRecord::Status::completed);
    CHECK(resumed.samples(again).size() == 50);
    CHECK(resumed.samples(resumed.trials()[1]).size() == 30'000);
}

TEST_CASE("a full disk is reported, again and again, and leaves the earlier trials readable", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header);
    enum : int { finish_did_not_throw = 2, start_did_not_throw, close_did_not_throw };
    const int status = in_child([&] {
        SessionStore store(session / session_file_name, patient());
        write_trial(store, header.schedule.trials[0]);
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{512 * 1024, 512 * 1024};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const auto fails = [](auto call) {
            try {
                call();
            } catch (const RecordError& error) {
                return std::string(error.what()).find("session.sqlite") != std::string::npos;
            }
            return false;
        };
        if (!fails([&] { write_trial(store, header.schedule.trials[1], 100'000); }))
            ::_exit(finish_did_not_throw);
        if (!fails([&] { store.trial_started(header.schedule.trials[2], at_ms(20000)); }))
            ::_exit(start_did_not_throw);
        if (!fails([&] { store.close(); }))
            ::_exit(close_did_not_throw);
        std::ofstream(root.path() / "lost") << store.lost().samples << ' ' << store.lost().flips;
    });
    REQUIRE(WIFEXITED(status));
    REQUIRE(WEXITSTATUS(status) == 0);

    const SessionRecord record(session);
    CHECK(record.damages().empty());
    CHECK_FALSE(record.closed_in_order());
    REQUIRE_FALSE(record.trials().empty());
    CHECK(record.trials()[0].status == TrialRecord::Status::completed);
    CHECK(record.samples(record.trials()[0]).size() == 1000);
    // What was not counted as lost is there.
    std::int64_t samples = 0, flips = 0;
    for (const TrialRecord& trial : record.trials()) {
        CHECK((trial.status == TrialRecord::Status::completed) == (trial.id == 1));
        samples += static_cast<std::int64_t>(record.samples(trial).size());
        flips += static_cast<std::int64_t>(record.flips(trial).size());
    }
    LostRows lost;
    std::ifstream(root.path() / "lost") >> lost.samples >> lost.flips;
    CHECK(lost.samples > 0);
    CHECK(samples + lost.samples == 101'000);
    CHECK(flips + lost.flips == 5050);
}

TEST_CASE("a session whose folder is moved away ends with the trial, and goes on when it is put back",
          "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const fs::path session = make_session(root.path(), header), away = root.path() / "away";
    {
        SessionStore store(session / session_file_name, patient());
        write_trial(store, header.schedule.trials[0]);
        fs::rename(session, away);
        CHECK_THROWS_WITH(write_trial(store, header.schedule.trials[1]),
                          Catch::Contains("was moved or deleted") && Catch::Contains("put the folder back") &&
                              Catch::Contains("--resume"));
        CHECK_THROWS_AS(store.close(), RecordError);
    }
    CHECK_FALSE(fs::exists(session));
    fs::rename(away, session);
    {
        const SessionRecord record(session);
        REQUIRE(record.trials().size() == 2);
        CHECK(record.trials()[1].status == TrialRecord::Status::completed);
        CHECK_FALSE(record.closed_in_order());
    }
    SessionStore store(session / session_file_name, patient());
    write_trial(store, header.schedule.trials[2]);
    store.close();
    CHECK(SessionRecord(session).trials().size() == 3);
}
