#include "experiment/record/session_store.h"

#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiment/error.h"
#include "experiment/record/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/spsc_ring.h"
#include "experiment/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

GazeSample sample_number(int number) {
    GazeSample sample;
    sample.sampled_at = TrackerTime(TrackerClock::duration(9'000'000'000'000 + 500 * number));
    sample.eye = number % 2 == 0 ? Eye::left : Eye::right;
    if (number % 5 != 0)
        sample.gaze = ScreenPoint{0.1 * number, -1.0 / (1 + number)};
    sample.pupil_area = 0.3f * static_cast<float>(number);
    return sample;
}

FlipRecord flip_number(int trial, int number) {
    FlipRecord flip;
    flip.trial = trial;
    flip.refresh_in_trial = number;
    flip.planned = {number % 3};
    flip.shown = {(number + 1) % 3};
    flip.pose = {(number + 2) % 3};
    const SessionTime blank(SessionDuration(123'456'789'012'345 + 10'000'000LL * number));
    flip.report = {{5'000'000'000 + number},
                   blank - SessionDuration(3),
                   blank - SessionDuration(2),
                   blank,
                   number % 2 == 0 ? VblankSource::virtual_display : VblankSource::swap_return,
                   number % 4};
    return flip;
}

void write_trial(SessionStore& store, const Trial& trial, int samples = 1000) {
    store.trial_started(trial, at_ms(trial.index * 10000));
    for (int i = 0; i < samples; ++i) {
        store.sample(trial.index, sample_number(i));
        if (i % 20 == 0)
            store.flip(flip_number(trial.index, i / 20));
    }
    store.trial_finished(trial, outcome_at(trial.index * 10000));
}

/// Runs this in another process and gives its wait status.
int in_child(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            work();
        } catch (...) {
            ::_exit(99);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

void require_same(const GazeSample& a, const GazeSample& b) {
    REQUIRE(a.sampled_at == b.sampled_at);
    REQUIRE(a.eye == b.eye);
    REQUIRE(a.gaze == b.gaze);
    REQUIRE(a.pupil_area == b.pupil_area);
}

void require_same(const FlipRecord& a, const FlipRecord& b) {
    REQUIRE(a.trial == b.trial);
    REQUIRE(a.refresh_in_trial == b.refresh_in_trial);
    REQUIRE(a.planned == b.planned);
    REQUIRE(a.shown == b.shown);
    REQUIRE(a.pose == b.pose);
    REQUIRE(a.report.refresh == b.report.refresh);
    REQUIRE(a.report.requested == b.report.requested);
    REQUIRE(a.report.swapped == b.report.swapped);
    REQUIRE(a.report.vertical_blank == b.report.vertical_blank);
    REQUIRE(a.report.source == b.report.source);
    REQUIRE(a.report.missed_refreshes == b.report.missed_refreshes);
}

} // namespace

TEST_CASE("a session's header comes back from the disk in every field", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader in = example_header();
    const SessionRecord record(make_session(root.path(), in));
    const SessionHeader& out = record.header();

    CHECK(out.protocol.name == in.protocol.name);
    CHECK(out.protocol.title == in.protocol.title);
    CHECK(out.protocol.text == in.protocol.text);
    CHECK(out.protocol.sha256 == in.protocol.sha256);
    CHECK(out.schedule.observer.label == in.schedule.observer.label);
    CHECK(out.schedule.observer.number == in.schedule.observer.number);
    CHECK(out.schedule.seed == in.schedule.seed);
    CHECK(out.schedule.trials == in.schedule.trials);
    CHECK(out.session_number == in.session_number);
    CHECK(out.started_utc == in.started_utc);
    CHECK(out.clock == in.clock);
    CHECK(out.program.version == in.program.version);
    CHECK(out.program.compiler == in.program.compiler);
    CHECK(out.program.flags == in.program.flags);
    CHECK(out.program.commit == in.program.commit);
    CHECK(out.graphics.context == in.graphics.context);
    CHECK(out.graphics.vendor == in.graphics.vendor);
    CHECK(out.graphics.renderer == in.graphics.renderer);
    CHECK(out.graphics.version == in.graphics.version);
    CHECK(out.tracker.name == in.tracker.name);
    CHECK(out.tracker.sample_rate_hz == in.tracker.sample_rate_hz);
    CHECK(out.tracker.eye == in.tracker.eye);
    CHECK(out.display.screen.screen_px == in.display.screen.screen_px);
    CHECK(out.display.screen.screen_mm == in.display.screen.screen_mm);
    CHECK(out.display.screen.viewing_distance_mm == in.display.screen.viewing_distance_mm);
    CHECK(out.display.screen.image_origin_px == in.display.screen.image_origin_px);
    CHECK(out.display.screen.image_px == in.display.screen.image_px);
    CHECK(out.display.refresh_hz == in.display.refresh_hz);
    CHECK(out.display.latency == in.display.latency);
    CHECK(out.display.output_mode == in.display.output_mode);
    CHECK(out.display.background == in.display.background);
    CHECK(out.animation.frame_count == in.animation.frame_count);
    CHECK(out.animation.frame_rate_hz == in.animation.frame_rate_hz);
    CHECK(out.animation.amplitude == in.animation.amplitude);
    CHECK(out.animation.playback == in.animation.playback);
    CHECK(out.animation.duration_s == in.animation.duration_s);
    CHECK(out.poses.angles == in.poses.angles);
    CHECK(out.poses.of_frame == in.poses.of_frame);
    REQUIRE(out.tasks.size() == 2);
    CHECK(out.tasks[1].id == in.tasks[1].id);
    CHECK(out.tasks[1].question == in.tasks[1].question);
    REQUIRE(out.materials.size() == 2);
    CHECK(out.materials[1].id == in.materials[1].id);
    CHECK(out.materials[1].title == in.materials[1].title);
    REQUIRE(out.sculptures.size() == 2);
    const RecordedSculpture &bust = out.sculptures[0], &given = in.sculptures[0];
    CHECK(bust.id == given.id);
    CHECK(bust.title == given.title);
    CHECK(bust.mesh_sha256 == given.mesh_sha256);
    CHECK(bust.mesh_file == given.mesh_file);
    CHECK(bust.part_names == given.part_names);
    CHECK(bust.camera.position == given.camera.position);
    CHECK(bust.camera.target == given.camera.target);
    CHECK(bust.camera.vertical_fov == given.camera.vertical_fov);
    CHECK(bust.axis_point == given.axis_point);
    CHECK(bust.bounds.min == given.bounds.min);
    CHECK(bust.bounds.max == given.bounds.max);
    REQUIRE(out.stimuli.size() == 2);
    CHECK(out.stimuli[1].condition == in.stimuli[1].condition);
    CHECK(out.stimuli[1].source == in.stimuli[1].source);
    CHECK(out.stimuli[0].frames_sha256 == in.stimuli[0].frames_sha256);
    REQUIRE(out.maps.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(out.maps[i].sculpture == in.maps[i].sculpture);
        CHECK(out.maps[i].pose == in.maps[i].pose);
        CHECK(out.maps[i].file == in.maps[i].file);
        CHECK(out.maps[i].sha256 == in.maps[i].sha256);
        CHECK(out.maps[i].made == in.maps[i].made);
        CHECK(out.maps[i].kind == in.maps[i].kind);
    }
}

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
        store.map_made({1, {0}, "maps/other.exr", "f", RecordedMap::Made::live});
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
    CHECK(record.clock_pairs(1)[0].tracker == pair.tracker);
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

TEST_CASE("what one thread pushes into the ring another pops in order, whole and once", "[unit]") {
    struct Item {
        std::uint64_t number, square;
    };
    constexpr std::uint64_t count = 200'000;
    SpscRing<Item> ring(64);
    std::thread producer([&] {
        for (std::uint64_t i = 0; i < count; ++i)
            while (!ring.try_push({i, i * i}))
                ring.wait_for_room();
    });
    std::uint64_t expected = 0, torn = 0, out_of_order = 0;
    Item item{};
    while (expected < count) {
        if (!ring.try_pop(item)) {
            std::this_thread::yield();
            continue;
        }
        ring.announce_room();
        torn += item.square != item.number * item.number;
        out_of_order += item.number != expected++;
    }
    producer.join();
    CHECK(torn == 0);
    CHECK(out_of_order == 0);
    CHECK_FALSE(ring.try_pop(item));
}

TEST_CASE("a ring takes as many items as it holds and then refuses", "[unit]") {
    SpscRing<int> ring(5);
    REQUIRE(ring.capacity() == 8);
    for (int i = 0; i < 8; ++i)
        CHECK(ring.try_push(i));
    CHECK_FALSE(ring.try_push(8));
    int item = -1;
    CHECK(ring.try_pop(item));
    CHECK(item == 0);
    CHECK(ring.try_push(8));
    CHECK(ring.size() == 8);
}

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

TEST_CASE("one session cannot be run twice at the same time", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = make_session(root.path(), example_header());
    const SessionStore store(session / session_file_name, patient());
    CHECK_THROWS_WITH(SessionStore(session / session_file_name, patient()), Contains("another program"));
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

TEST_CASE("sessions of an observer are numbered on, and none is overwritten", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const SessionPlace place{root.path() / "sessions", "tiny", "AB7"};
    CHECK(next_session_number(place) == 1);
    CHECK(make_session(place.root, header) == place.root / "tiny" / "sub-AB7_ses-01");
    CHECK(make_session(place.root, header) == place.root / "tiny" / "sub-AB7_ses-02");
    CHECK(next_session_number({place.root, "tiny", "AB"}) == 1);
    CHECK_THROWS_WITH(SessionDirectory(place, 1), Contains("exists already") && Contains("number is 3"));
    CHECK_THROWS_AS(SessionDirectory(place, 2), InputError);
    CHECK_THROWS_AS(SessionDirectory(place, 0), InputError);
    CHECK(SessionDirectory(place, 12).session_number() == 12);
}

TEST_CASE("names that would not make one folder are refused", "[unit]") {
    const TemporaryFolder root;
    for (const char* label : {"", "a b", "../x", "sub-1", "ä"})
        CHECK_THROWS_AS(session_path({root.path(), "tiny", label}, 1), InputError);
    for (const char* name : {"", "a/b", "..", ".hidden", "a b"})
        CHECK_THROWS_AS(session_path({root.path(), name, "1"}, 1), InputError);
}

TEST_CASE("a session that was never published leaves nothing behind", "[unit]") {
    const TemporaryFolder root;
    const SessionPlace place{root.path(), "tiny", "1"};
    {
        const SessionDirectory directory(place);
        create_session_file(directory.session_file(), example_header());
        CHECK(fs::exists(directory.session_file()));
        CHECK_FALSE(fs::exists(session_path(place, 1)));
        CHECK(next_session_number(place) == 1);
        CHECK_THROWS_AS(create_session_file(directory.session_file(), example_header()), RecordError);
    }
    CHECK(fs::is_empty(root.path() / "tiny"));
}

TEST_CASE("of two sessions made at once under one number only the first gets its name", "[unit]") {
    const TemporaryFolder root;
    const SessionPlace place{root.path(), "tiny", "1"};
    SessionDirectory first(place, 1), second(place, 1);
    create_session_file(first.session_file(), example_header());
    create_session_file(second.session_file(), example_header());
    first.publish();
    CHECK_THROWS_AS(second.publish(), InputError);
    second.abandon();
    CHECK(std::distance(fs::directory_iterator(root.path() / "tiny"), fs::directory_iterator()) == 1);
    CHECK(SessionRecord(first.path()).header().protocol.name == "tiny");
}
