/// Fixations, saccades and blinks that are found in imported samples: over the recording as a whole.
#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/table_export.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/events/detected_events.h"
#include "tests/support/planted_asc.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::testing;
using Kind = GazeEvent::Kind;
using From = SessionRecord::EventOrigin::From;
namespace fs = std::filesystem;

namespace {

constexpr double px_per_deg = 40.0; // as planted_asc_text() says

PlantedGaze planted_gaze() {
    PlantedGaze planted =
        plant_gaze({.rate_hz = 500.0, .duration_s = 30.0, .noise_deg = 0.02, .blinks_per_minute = 20.0},
                   ScreenGeometry{});
    // As they come back from a file with three decimals.
    for (GazeSample& sample : planted.samples)
        if (sample.gaze)
            sample.gaze = ScreenPoint{std::stod(fmt::format("{:.3f}", sample.gaze->x_px)),
                                      std::stod(fmt::format("{:.3f}", sample.gaze->y_px))};
    return planted;
}

AscImportOptions planted_into(const fs::path& out) {
    AscImportOptions options;
    options.place = {out.parent_path(), "planted", "1"};
    options.out = out;
    return options;
}

struct OfTrial {
    std::vector<GazeEvent> within, after;
};

std::vector<OfTrial> events_by_trial(const SessionRecord& record) {
    std::vector<OfTrial> all;
    for (const TrialRecord& trial : record.trials()) {
        OfTrial& of = all.emplace_back();
        const auto into = [](std::vector<GazeEvent>& list) {
            return [&list](const GazeEvent& event) {
                if (is_eye_event(event.kind))
                    list.push_back(event);
            };
        };
        record.read_gaze_events(trial, into(of.within));
        record.read_gaze_events_after(trial, into(of.after));
    }
    return all;
}

std::vector<GazeEvent> all_events(const SessionRecord& record) {
    std::vector<GazeEvent> all;
    for (const OfTrial& of : events_by_trial(record)) {
        all.insert(all.end(), of.within.begin(), of.within.end());
        all.insert(all.end(), of.after.begin(), of.after.end());
    }
    return all;
}

/// Every 1.7 s, mostly in the midst of a fixation.
std::vector<int> every_1700_ms(int offset_ms) {
    std::vector<int> times_ms;
    for (int at_ms = offset_ms; at_ms < 29'000; at_ms += 1700)
        times_ms.push_back(at_ms);
    return times_ms;
}

} // namespace

TEST_CASE("events are found over a recording as a whole, however it is cut into trials", "[unit]") {
    const test::TemporaryFolder root;
    const PlantedGaze planted = planted_gaze();
    const bool has_results = GENERATE(false, true);
    CAPTURE(has_results);
    const fs::path file =
        write_planted_asc(root.path() / "cut.asc", planted,
                          {.trial_ids_ms = every_1700_ms(500),
                           .trial_results_ms = has_results ? every_1700_ms(1700) : std::vector<int>()});
    import_asc(file, planted_into(root.path() / "session"));
    SessionRecord record(root.path() / "session");
    REQUIRE(record.trials().size() > 10);
    record.detect_events_of_imports();
    const SessionRecord::EventOrigin origin = record.event_origin(1);
    REQUIRE(origin.from == From::reading);
    CHECK(all_events(record) == detect(planted.samples, origin.settings, GazeAngles(px_per_deg, px_per_deg)));
    // Each belongs to the trial, or to what is after it, that its last sample is of.
    const std::vector<OfTrial> by_trial = events_by_trial(record);
    std::size_t after = 0;
    for (std::size_t i = 0; i < by_trial.size(); ++i) {
        const auto span = record.sample_span(record.trials()[i]);
        REQUIRE(span);
        for (const GazeEvent& event : by_trial[i].within)
            CHECK((span->first <= event.end && event.end <= span->second));
        for (const GazeEvent& event : by_trial[i].after)
            CHECK(event.end > span->second);
        after += by_trial[i].after.size();
    }
    CHECK((after > 10) == has_results);
    // Tables and ASC files have all of them, too.
    export_tables(
        record, [](const ViewedObject&) -> const SurfaceLookup* { return nullptr; }, root.path() / "tables");
    const test::TsvFile table(root.path() / "tables" / "gaze_events.tsv");
    std::size_t rows = 0;
    for (std::size_t i = 0; i < table.size(); ++i)
        if (const std::string kind = table.text(i, "kind");
            kind == "fixation" || kind == "saccade" || kind == "blink") {
            CHECK(table.text(i, "detector") == "overt at export");
            ++rows;
        }
    CHECK(rows == all_events(record).size());
    export_asc(record, root.path() / "asc");
    import_asc(root.path() / "asc" / "sub-1_ses-01_run-01.asc", planted_into(root.path() / "again"));
    const SessionRecord again(root.path() / "again");
    CHECK(again.event_origin(1).from == From::tracker);
    for (const Kind kind : {Kind::fixation, Kind::saccade, Kind::blink}) {
        INFO(name_of(kind));
        CHECK(of_kind(all_events(again), kind).size() == of_kind(all_events(record), kind).size());
    }
}

TEST_CASE("what an eye does lasts no longer than the tracker's own recording", "[unit]") {
    const test::TemporaryFolder root;
    PlantedGaze resting;
    for (int ms = 0; ms < 4000; ms += 2)
        resting.samples.push_back(
            {tracker_time(1000 * (5000 + ms)), Eye::right, ScreenPoint{900.0, 500.0}, 1000.0f});
    const fs::path file =
        write_planted_asc(root.path() / "two.asc", resting, {.trial_ids_ms = {100}, .starts_ms = {2000}});
    import_asc(file, planted_into(root.path() / "session"));
    SessionRecord record(root.path() / "session");
    record.detect_events_of_imports();
    const std::vector<GazeEvent> events = all_events(record);
    REQUIRE(events.size() == 2);
    CHECK(events[0].end == tracker_time(1000 * 6998));
    CHECK(events[1].start == tracker_time(1000 * 7000));
}

TEST_CASE("readers that work together find the same", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path file =
        write_planted_asc(root.path() / "cut.asc", planted_gaze(), {.trial_ids_ms = every_1700_ms(500)});
    import_asc(file, planted_into(root.path() / "session"));
    SessionRecord one(root.path() / "session"), other(root.path() / "session");
    ChosenThresholds chosen;
    chosen.values[0] = 50.0;
    one.detect_events(chosen);
    other.detect_events_as(one);
    REQUIRE(all_events(other).size() > 50);
    CHECK(all_events(other) == all_events(one));
    CHECK(other.event_origin(1).settings.velocity_deg_s == 50.0);
}

TEST_CASE("an import notes by which thresholds events are to be found, and keeps the tracker's own",
          "[unit]") {
    const test::TemporaryFolder root;
    const PlantedGaze planted = planted_gaze();
    const fs::path file =
        write_planted_asc(root.path() / "own.asc", planted, {.has_events = true, .trial_ids_ms = {0}});
    AscImportOptions options = planted_into(root.path() / "session");
    options.detect_events.emplace().values[0] = 45.0;
    const AscImportSummary summary = import_asc(file, options);
    CHECK(std::any_of(summary.remarks.begin(), summary.remarks.end(), [](const std::string& remark) {
        return remark.find("velocity 45 deg/s,") != std::string::npos;
    }));
    const SessionRecord record(root.path() / "session");
    const SessionRecord::EventOrigin origin = record.event_origin(1);
    REQUIRE(origin.from == From::reading);
    CHECK(origin.settings.velocity_deg_s == 45.0);
    CHECK_THAT(record.event_origins(), Catch::Matchers::Contains("velocity 45 deg/s,") &&
                                           Catch::Matchers::Contains("measured speed "));
    CHECK(all_events(record) == detect(planted.samples, origin.settings, GazeAngles(px_per_deg, px_per_deg)));
    SQLite::Database database((root.path() / "session" / session_file_name).string());
    const int on_record =
        database.execAndGet("SELECT COUNT(*) FROM gaze_event WHERE kind = 'fixation'").getInt();
    CHECK(on_record == static_cast<int>(of_kind(planted.events, Kind::fixation).size()));
    // Sealed with the rest.
    std::set<std::string> damaged;
    for (const Damage& damage : verify_session(root.path() / "session").damages)
        damaged.insert(damage.table);
    CHECK(damaged.empty());
}

TEST_CASE("where angles are unknown nothing is found, and it is said", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path file = write_planted_asc(root.path() / "flat.asc", planted_gaze(),
                                            {.tells_resolution = false, .trial_ids_ms = {0}});
    AscImportOptions asked = planted_into(root.path() / "asked");
    asked.detect_events.emplace();
    CHECK_THROWS_WITH(import_asc(file, asked), Catch::Matchers::Contains("flat.asc") &&
                                                   Catch::Matchers::Contains("--screen-mm") &&
                                                   Catch::Matchers::Contains("--distance-mm"));
    CHECK_FALSE(fs::exists(root.path() / "asked"));
    const AscImportSummary summary = import_asc(file, planted_into(root.path() / "session"));
    CHECK(std::any_of(summary.remarks.begin(), summary.remarks.end(), [](const std::string& remark) {
        return remark.find("angles are unknown") != std::string::npos;
    }));
    SessionRecord record(root.path() / "session");
    record.detect_events_of_imports();
    CHECK(record.event_origin(1).from == From::no_angles);
    CHECK(all_events(record).empty());
    CHECK_THAT(record.event_origins(), Catch::Matchers::Contains("angles are unknown"));
    // With the screen they are found.
    asked.screen_mm = glm::dvec2(698.0, 393.0);
    asked.viewing_distance_mm = 1750.0;
    import_asc(file, asked);
    CHECK(all_events(SessionRecord(root.path() / "asked")).size() > 50);
}
