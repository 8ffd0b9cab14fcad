/// A session that is played back: its set-ups, its attempts at each trial, and what it showed.
#include <catch2/catch.hpp>

#include "devices/replay/replay_tracker.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/counted_clock.h"
#include "tests/support/diary_setup_screen.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// Two set-ups; of the first trial (a bust of silver) two attempts and one without gaze between them, of the
/// second trial (a vase of gold) one. The tracker's clock is 7 s ahead.
struct ReplayedSession {
    ReplayedSession() {
        using namespace overt::testing;
        const SessionHeader header = example_header();
        session = make_session(root.path(), header);
        SessionStore store(session / session_file_name, patient());
        for (const int second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second), tracker_time(1'000'000 * (second + 7)), at_ms(1000 * second)});
        for (const double error_deg : {0.5, 0.25}) {
            RecordedCalibration calibration;
            calibration.at = at_ms(500);
            calibration.method = error_deg == 0.5 ? "the first" : "the second";
            calibration.validation.mean_error = {error_deg};
            calibration.validation.max_error = {1.0};
            store.calibration(calibration);
        }
        const auto attempt = [&](int trial, std::int64_t start_ms, double x_px, double drift_deg) {
            const Trial& of = header.schedule.trials[static_cast<std::size_t>(trial)];
            store.trial_started(of, at_ms(start_ms));
            for (int i = 0; x_px > 0.0 && i < 20; ++i) {
                GazeSample sample;
                sample.sampled_at = tracker_time(1000 * (start_ms + 7000 + 990 + i));
                sample.eye = Eye::left;
                sample.gaze = ScreenPoint{x_px + i, 300.0};
                sample.pupil_area = 900.0f;
                store.sample(trial, sample);
            }
            TrialOutcome outcome = outcome_at(start_ms);
            outcome.drift = Degrees{drift_deg};
            store.trial_finished(of, outcome);
        };
        attempt(0, 10'000, 100.0, 0.5);
        attempt(0, 20'000, 0.0, 0.6);
        attempt(0, 30'000, 200.0, 0.75);
        attempt(1, 40'000, 300.0, 1.0);
        store.close();
    }

    TemporaryFolder root;
    std::filesystem::path session;
};

} // namespace

TEST_CASE("a session's set-ups are played back one after the other, and the last of them again", "[unit]") {
    const ReplayedSession played;
    CountedClock clock;
    ReplayTracker tracker(played.session, clock);
    CHECK(tracker.description().eye == Eye::left);
    CHECK(tracker.description().sample_rate_hz == 2000.0);
    CHECK_FALSE(tracker.description().both_eyes);
    CHECK_FALSE(tracker.tells_events());
    DiarySetupScreen screen(clock);
    for (const auto& [method, error_deg] :
         {std::pair("the first", 0.5), {"the second", 0.25}, {"the second", 0.25}}) {
        const SetupOutcome outcome = tracker.set_up(screen);
        CHECK(outcome.kind == SetupOutcome::Kind::done);
        CHECK(outcome.method == method);
        REQUIRE(outcome.validation);
        CHECK(outcome.validation->mean_error.value == error_deg);
        CHECK(outcome.message.empty());
    }
}

TEST_CASE("a session's attempts that have gaze are played back in turn, each with its drift, about its onset",
          "[unit]") {
    const ReplayedSession played;
    CountedClock clock;
    ReplayTracker tracker(played.session, clock);
    std::array<TrackerItem, 64> items;
    for (const auto& [mark, drift_deg, x_px] : {std::tuple("TRIALID 1", 0.5, 100.0),
                                                {"TRIALID 1", 0.75, 200.0},
                                                {"TRIALID 1", 0.75, 200.0},
                                                {"TRIALID 2", 1.0, 300.0}}) {
        clock.time += 5s;
        tracker.mark({clock.time, mark});
        const DriftOutcome drift = tracker.drift_check({});
        CHECK(drift.kind == DriftOutcome::Kind::measured);
        CHECK(drift.error.value == drift_deg);
        tracker.start_recording();
        CHECK(tracker.poll(items) == 0);
        tracker.mark({clock.time, "SYNCTIME"});
        // Ten milliseconds before the onset are there already, and the sample of the onset itself.
        REQUIRE(tracker.poll(items) == 11);
        CHECK(std::get<GazeSample>(items[0]).gaze->x_px == x_px);
        CHECK(std::get<GazeSample>(items[10]).sampled_at == tracker.read_clocks()->other);
        clock.time += 1s;
        CHECK(tracker.poll(items) == 9);
        tracker.stop_recording();
    }
    CHECK(tracker.finish("", {}).empty());
}

TEST_CASE("a trial that shows what the session did not is told, by its object or its material", "[unit]") {
    const ReplayedSession played;
    for (const auto& [words, is_other] : {std::pair("object bust", false),
                                          {"object vase", true},
                                          {"material silver", false},
                                          {"material gold", true}}) {
        CountedClock clock;
        ReplayTracker tracker(played.session, clock);
        tracker.mark({clock.time, "TRIALID 1"});
        tracker.start_recording();
        tracker.mark({clock.time, "SYNCTIME"});
        tracker.stop_recording();
        const std::string mark = std::string("!V TRIAL_VAR ") + words;
        tracker.mark({clock.time, mark});
        const std::vector<std::string> said = tracker.finish("", {});
        REQUIRE(said.size() == (is_other ? 1 : 0));
        if (is_other)
            CHECK_THAT(said[0],
                       Catch::StartsWith("1 trial showed another stimulus than the recording's: 1."));
    }
}
