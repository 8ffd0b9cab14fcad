/// What the observer moved, in the record and in tables.
#include <catch2/catch.hpp>

#include "experiment/record/read/observer_turns.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/shown_levels.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

GivenAnswer set_match() {
    GivenAnswer given{.id = "gloss", .item = {}, .kind = "match"};
    given.is_missed = false;
    given.value = "0.2";
    given.number = 0.2;
    given.slot = 0;
    given.settings = {{"roughness", 0.1, 0.2, 0.1, 0.4, 0.25, 7, 3, 2, 1},
                      {"shade", 2.0, 1.0, 1.0, 2.0, std::nullopt, 1, 0, 0, 0}};
    given.levels = {{0, {.object = 0, .material = 0}, {0.1, 1.0}},
                    {1, {.object = 0, .material = 1}, {0.1, 2.0}}};
    return given;
}

FlipRecord steered_flip_at(int trial, int refresh, int frame, int pose) {
    FlipRecord flip{trial, refresh, {frame}, {frame}, {pose}, {}};
    flip.report.refresh = {1000 + refresh};
    flip.report.vertical_blank = at_ms(1000 + 10 * refresh);
    flip.step = 1;
    return flip;
}

} // namespace

TEST_CASE("settings, levels and what each flip contains come back as they were written", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const auto session = make_session(root.path(), header);
    const Trial& trial = header.schedule.trials[2];
    TrialOutcome outcome = outcome_at(0);
    GivenAnswer other{.id = "sure", .item = {}, .kind = "scale"};
    outcome.given = {other, set_match()};
    const SteeredFlip first{2, 0, 0, 0, {}}, second{2, 1, 0, 1, at_ms(1003)};
    {
        SessionStore store(session / session_file_name, patient());
        store.trial_started(trial, at_ms(0));
        store.flip(steered_flip_at(2, 0, 0, 0));
        store.steered_flip(first);
        store.flip(steered_flip_at(2, 1, 0, 0));
        store.steered_flip(second);
        store.trial_finished(trial, outcome);
        store.close();
    }
    const SessionRecord record(session);
    REQUIRE(record.trials().size() == 1);
    const TrialRecord seen = record.trials().front().seen_in(0);
    REQUIRE(seen.outcome.given.size() == 2);
    CHECK(seen.outcome.given[0].settings.empty());
    CHECK(seen.outcome.given[1].settings == outcome.given[1].settings);
    CHECK(seen.outcome.given[1].levels == outcome.given[1].levels);
    CHECK(seen.outcome.given[1].slot == 0);
    CHECK(record.steered_flips(seen) == std::vector{first, second});
    const ShownLevels levels(record, seen);
    CHECK(levels.at({1000}).material == 0);
    CHECK(levels.at({1001}).material == 1);
    CHECK(levels.at({5}) == trial.stimulus);
    CHECK(record.damages().empty());
}

TEST_CASE("path, net turn, time and reversals of a turning follow from its flips", "[unit]") {
    PoseTable poses;
    for (int i = 0; i < 36; ++i)
        poses.angles.push_back({{10.0 * i}});
    // 0, 350, 340, 340, 350, 0, 10: over the seam by the shorter way.
    const int shown[] = {0, 35, 34, 34, 35, 0, 1};
    std::vector<FlipRecord> flips;
    std::vector<SteeredFlip> steered;
    for (int i = 0; i < 7; ++i) {
        flips.push_back(steered_flip_at(0, i, shown[i], shown[i]));
        SteeredFlip& moved = steered.emplace_back();
        moved.refresh_in_trial = i;
        if (i > 0)
            moved.input_at = at_ms(i < 4 ? 1004 : 1030);
    }
    const ObserverTurns turns = turns_of(flips, steered, poses);
    CHECK(turns.start.value == 0.0);
    CHECK(turns.end.value == 10.0);
    CHECK(turns.net.value == Approx(10.0));
    CHECK(turns.path.value == Approx(50.0));
    CHECK(turns.turning_s == Approx(0.05));
    CHECK(turns.seconds == Approx(0.06));
    CHECK(turns.changes == 5);
    CHECK(turns.reversals == 1);
    CHECK(turns.poses == 4);
    CHECK(turns.step == 1);
    // 1010 - 1004 and 1040 - 1030.
    CHECK(*turns.median_delay_s == Approx(0.008));
    CHECK(*turns.longest_delay_s == Approx(0.010));
    CHECK_FALSE(turns_of(flips, {}, poses).median_delay_s);
    CHECK(delays_in(flips, steered).size() == 2);
}

TEST_CASE("a path is of the angles between poses, whatever they turn about", "[unit]") {
    PoseTable poses;
    for (const auto& [angle, elevation] :
         {std::pair(0.0, 0.0), std::pair(10.0, 0.0), std::pair(10.0, 20.0), std::pair(0.0, 20.0)})
        poses.angles.push_back(turned_and_tilted({angle}, {elevation}));
    std::vector<FlipRecord> flips;
    for (int i = 0; i < 4; ++i)
        flips.push_back(steered_flip_at(0, i, i, i));
    const ObserverTurns turns = turns_of(flips, {}, poses);
    CHECK(turns.start_elevation.value == 0.0);
    CHECK(turns.end_elevation.value == Approx(20.0));
    CHECK(turns.net.value == Approx(0.0).margin(1e-9));
    // A tilt by 20 deg; and a turn of a tilted object is about its tilted axis, by as much.
    CHECK(turns.path.value == Approx(10.0 + 20.0 + 10.0));
    CHECK(turns.changes == 3);
    CHECK(turns.reversals == 1);
    CHECK(turns.poses == 4);
}

TEST_CASE("of the delays of inputs 95 % are no longer than what is said", "[unit]") {
    CHECK_FALSE(summary_of(std::vector<double>()));
    CHECK(summary_of(std::vector{0.02}) == InputDelays{1, 0.02, 0.02, 0.02});
    std::vector<double> delays_s;
    for (int i = 100; i > 0; --i)
        delays_s.push_back(i);
    CHECK(summary_of(delays_s) == InputDelays{100, 50.5, 95.0, 100.0});
    delays_s.pop_back();
    CHECK(summary_of(delays_s)->most_s == 96.0); // of 99: 94 would be too few
    delays_s = {3.0, 1.0, 2.0};
    CHECK(summary_of(delays_s) == InputDelays{3, 2.0, 3.0, 3.0});
}
