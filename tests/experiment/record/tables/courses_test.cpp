/// How objects were turned, as a table that a protocol can show again.
#include <catch2/catch.hpp>

#include "experiment/record/read/observer_turns.h"
#include "experiment/record/tables/table_export.h"
#include "tests/experiment/record/tables/recorded_trials.h"

using namespace overt;
using namespace overt::testing;

TEST_CASE("a course has a row for each pose from the show's onset on, and one for its end", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = example_header();
    Animation& motion = header.animations.front();
    motion.kind = MotionKind::observer;
    motion.by_observer.elevation_step = Degrees{10.0};
    motion.by_observer.elevation_to = Degrees{10.0};
    header.poses.angles[2] = turned_and_tilted({12.5}, {10.0});
    const fs::path session = make_session(root.path(), header);
    const Trial& trial = header.schedule.trials[0];
    {
        SessionStore store(session / session_file_name, patient());
        store.trial_started(trial, at_ms(0));
        // At 100 Hz; the fourth refresh was missed, and the picture before stood.
        const std::pair<int, int> lit[] = {{0, 0}, {1, 0}, {2, 1}, {4, 2}, {5, 2}, {6, 0}};
        for (const auto& [refresh, pose] : lit) {
            FlipRecord flip{trial.index, refresh, {pose}, {pose}, {pose}, {}};
            flip.report.refresh = {1000 + refresh};
            flip.report.vertical_blank = at_ms(1000 + 10 * refresh);
            flip.missed_refreshes = refresh == 4 ? 1 : 0;
            store.flip(flip);
            SteeredFlip moved{trial.index, refresh, 0, -1, {}};
            if (refresh > 1)
                moved.input_at = at_ms(refresh < 6 ? 1008 : 1051);
            store.steered_flip(moved);
        }
        store.trial_finished(trial, outcome_at(0));
        store.close();
    }
    const SessionRecord record(session);
    CHECK(record.header().animations.front().by_observer.elevation_to.value == 10.0);
    export_tables(record, bust_only, root.path() / "tables");
    const auto courses = rows_of(root.path() / "tables/courses.tsv");
    REQUIRE(courses.size() == 1 + 5);
    const std::tuple<const char*, double, double> wanted[] = {{"0.000000000", -12.5, 0.0},
                                                              {"0.020000000", 0.1, 0.0},
                                                              {"0.040000000", 12.5, 10.0},
                                                              {"0.060000000", -12.5, 0.0},
                                                              {"0.070000000", -12.5, 0.0}};
    for (std::size_t i = 0; i < 5; ++i) {
        auto row = row_of(courses, i + 1);
        const auto& [t_s, angle_deg, elevation_deg] = wanted[i];
        CAPTURE(i);
        CHECK(row["observer"] == "AB7");
        CHECK(row["session"] == "3");
        CHECK(row["trial"] == "1");
        CHECK(row["object"] == "bust");
        CHECK(row["t_s"] == t_s);
        CHECK(std::stod(row["angle_deg"]) == Approx(angle_deg).margin(1e-9));
        CHECK(std::stod(row["elevation_deg"]) == Approx(elevation_deg).margin(1e-9));
    }
    auto turns = row_of(rows_of(root.path() / "tables/turns.tsv"), 1);
    CHECK(std::stod(turns["start_elevation_deg"]) == 0.0);
    CHECK(turns["changes"] == "3");
    // 1020 - 1008 and 1060 - 1051.
    const std::optional<InputDelays> delays = input_delays(record);
    REQUIRE(delays);
    CHECK(delays->count == 2);
    CHECK(delays->median_s == Approx(0.0105).margin(1e-4));
    CHECK(delays->most_s == Approx(0.012).margin(1e-4));
}
