/// Fixations, saccades and blinks of a session: found while it is recorded, read, exported and imported
/// again.
#include <set>

#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>
#include <nlohmann/json.hpp>

#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/bids/bids_export.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/table_export.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/events/detected_events.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/gzip_file.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;
using From = SessionRecord::EventOrigin::From;
namespace fs = std::filesystem;

namespace {

/// Milliseconds by which the tracker's clock is ahead.
constexpr std::int64_t ahead_ms = 7'000'000;
constexpr EventSettings strict{.velocity_deg_s = 40.0};

SessionHeader header_with_trials() {
    SessionHeader header = example_header();
    header.session_number = 1;
    header.tracker = {"simulated", 1000.0, Eye::right};
    return header;
}

/// Of a trial: three seconds at 1000 Hz.
std::vector<GazeSample> planted_samples(std::uint64_t trial) {
    PlantedGaze planted =
        plant_gaze({.rate_hz = 1000.0, .duration_s = 3.0, .blinks_per_minute = 60.0, .seed = trial},
                   header_with_trials().display.screen);
    for (GazeSample& sample : planted.samples)
        sample.sampled_at +=
            std::chrono::milliseconds(ahead_ms + 10'000 * (static_cast<std::int64_t>(trial) + 1));
    return planted.samples;
}

/// Records two trials; the events are found meanwhile by these settings, if there are any.
fs::path record_session(const fs::path& root, const std::optional<EventSettings>& settings) {
    const SessionHeader header = header_with_trials();
    fs::path session = make_session(root, header);
    SessionStore::Options options = patient();
    if (settings)
        options.detection = SittingDetection{*settings, header.display.screen};
    SessionStore store(session / session_file_name, options);
    for (const std::int64_t second : {0, 100})
        store.clock_pair({at_ms(1000 * second),
                          TrackerTime(std::chrono::milliseconds(ahead_ms + 1000 * second)),
                          at_ms(1000 * second)});
    for (std::uint64_t trial = 0; trial < 2; ++trial) {
        const std::int64_t start_ms = 10'000 * (static_cast<std::int64_t>(trial) + 1);
        // A sample that belongs to no trial makes no event.
        store.sample(-1, {TrackerTime(std::chrono::milliseconds(ahead_ms + start_ms)), Eye::right,
                          ScreenPoint{1.0, 1.0}, 1.0f});
        store.trial_started(header.schedule.trials[trial], at_ms(start_ms));
        for (const GazeSample& sample : planted_samples(trial))
            store.sample(static_cast<int>(trial), sample);
        store.trial_finished(header.schedule.trials[trial], outcome_at(start_ms));
    }
    store.close();
    return session;
}

std::vector<GazeEvent> eye_events(const SessionRecord& record, std::size_t trial) {
    std::vector<GazeEvent> events;
    record.read_gaze_events(record.trials().at(trial), [&](const GazeEvent& event) {
        if (is_eye_event(event.kind))
            events.push_back(event);
    });
    return events;
}

std::vector<GazeEvent> expected_events(std::size_t trial, const EventSettings& settings) {
    return detect(planted_samples(trial), settings, GazeAngles(header_with_trials().display.screen));
}

double measured_noise_deg_s(const SessionRecord::EventOrigin& origin) {
    return nlohmann::json::parse(origin.detection.parameters).at("measured_speed_deg_s").get<double>();
}

/// Its other files are not there, which is not what is asked.
std::set<std::string> damaged_tables(const fs::path& session) {
    std::set<std::string> tables;
    for (const Damage& damage : verify_session(session).damages)
        if (!damage.table.empty())
            tables.insert(damage.table);
    return tables;
}

} // namespace

TEST_CASE("a session records the events of its trials, with who found them and how", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = record_session(root.path(), strict);
    const SessionRecord record(session);
    for (const std::size_t trial : {0u, 1u}) {
        const std::vector<GazeEvent> expected = expected_events(trial, strict);
        REQUIRE(expected.size() > 5);
        REQUIRE(expected != expected_events(trial, {.velocity_deg_s = 80.0}));
        CHECK(eye_events(record, trial) == expected);
    }
    std::vector<GazeEvent> outside;
    record.read_gaze_events_outside([&](const GazeEvent& event) { outside.push_back(event); });
    CHECK(outside.empty());
    const SessionRecord::EventOrigin origin = record.event_origin(1);
    CHECK(origin.from == From::recording);
    CHECK(origin.detection == detection_by(strict));
    CHECK_THAT(origin.detection.parameters, Contains("\"velocity_deg_s\":40,"));
    CHECK_THAT(record.event_origins(), Contains("while the session was recorded") && Contains("version 1"));
    CHECK(damaged_tables(session).empty());
    // Each of them is sealed with its trial.
    const auto& [table, sql] = GENERATE(
        std::pair("gaze_event", "UPDATE gaze_event SET end_us = end_us + 1 WHERE trial_id = 2 AND n = 3"),
        std::pair("event_detection", "UPDATE event_detection SET parameters = '{}'"));
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
    CHECK(damaged_tables(session) == std::set<std::string>{table});
}

TEST_CASE("a session without events has them found when it is read, by its rate and noise, and says so",
          "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = record_session(root.path(), std::nullopt);
    const SessionRecord record(session);
    const SessionRecord::EventOrigin origin = record.event_origin(1);
    CHECK(origin.from == From::reading);
    CHECK(origin.settings == usual_settings(GazeNoise{1.0, measured_noise_deg_s(origin)}));
    for (const std::size_t trial : {0u, 1u})
        CHECK(eye_events(record, trial) == expected_events(trial, origin.settings));
    CHECK_THAT(record.event_origins(), Contains("afterwards, in the recorded samples"));
    // Of earlier programs' sessions, which had no such table.
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE)
        .exec("DROP TABLE event_detection; DROP TABLE gaze_event; DROP TABLE gaze_source");
    CHECK(eye_events(SessionRecord(session), 1) == expected_events(1, origin.settings));
}

TEST_CASE("events stand in the tables, in BIDS and in ASC, and those of ASC come back", "[unit]") {
    const test::TemporaryFolder root;
    const bool is_live = GENERATE(true, false);
    const fs::path session =
        record_session(root.path() / "sessions", is_live ? std::optional(EventSettings{}) : std::nullopt);
    const SessionRecord record(session);
    const auto no_surface = [](const ViewedObject&) -> const SurfaceLookup* { return nullptr; };

    export_tables(record, no_surface, root.path() / "tables");
    const test::TsvFile table(root.path() / "tables" / "gaze_events.tsv");
    const std::vector<GazeEvent> first = eye_events(record, 0), second = eye_events(record, 1);
    REQUIRE(table.size() == first.size() + second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(table.text(i, "kind") == name_of(first[i].kind));
        CHECK(table.text(i, "detector") == (is_live ? "overt" : "overt at export"));
        CHECK(table.integer(i, "tracker_start_us") == first[i].start.time_since_epoch().count());
        CHECK(table.number(i, "duration_s") == Approx(1e-6 * static_cast<double>(first[i].duration.count())));
        if (first[i].kind == GazeEvent::Kind::saccade && first[i].amplitude_deg)
            CHECK(table.number(i, "amplitude_deg") == Approx(*first[i].amplitude_deg).margin(5e-4));
    }
    const std::string dictionary = text_of(root.path() / "tables" / "dictionary.json");
    CHECK_THAT(dictionary, Contains("by the detector of overt, version 1") && Contains("velocity_deg_s"));

    export_bids(record, no_surface, root.path() / "bids");
    const fs::path beh = root.path() / "bids" / "sub-AB7" / "ses-01" / "beh";
    const std::string stem = "sub-AB7_ses-01_task-tiny_run-01_recording-eye1_physioevents";
    const std::string rows = unpacked(beh / (stem + ".tsv.gz"));
    CHECK(std::count(rows.begin(), rows.end(), '\n') >
          static_cast<std::ptrdiff_t>(first.size() + second.size()));
    for (const GazeEvent& event : first)
        CHECK_THAT(rows, Contains(fmt::format("{}\t{:.6f}\t{}\t", event.start.time_since_epoch().count(),
                                              1e-6 * static_cast<double>(event.duration.count()),
                                              name_of(event.kind))));
    CHECK_THAT(text_of(beh / (stem + ".json")), Contains("by the detector of overt"));

    export_asc(record, root.path() / "asc");
    const fs::path asc = root.path() / "asc" / "sub-AB7_ses-01_run-01.asc";
    CHECK_THAT(text_of(asc), Contains("** REMARK: Fixations, saccades and blinks were found") &&
                                 Contains("\nEFIX R   ") && Contains("\nSSACC R  ") &&
                                 Contains("\nEBLINK R "));
    AscImportOptions into;
    into.place = {root.path(), "again", "1"};
    into.out = root.path() / "again";
    import_asc(asc, into);
    const SessionRecord again(root.path() / "again");
    CHECK(again.event_origin(1).from == From::tracker);
    for (const std::size_t trial : {0u, 1u}) {
        std::vector<GazeEvent> ours = eye_events(record, trial), theirs = eye_events(again, trial);
        const auto by_begin = [](const GazeEvent& a, const GazeEvent& b) {
            return std::pair(a.start, a.kind) < std::pair(b.start, b.kind);
        };
        std::sort(ours.begin(), ours.end(), by_begin);
        std::sort(theirs.begin(), theirs.end(), by_begin);
        REQUIRE(theirs.size() == ours.size());
        for (std::size_t i = 0; i < ours.size(); ++i) {
            CHECK(theirs[i].kind == ours[i].kind);
            CHECK(theirs[i].eye == ours[i].eye);
            CHECK(theirs[i].start == ours[i].start);
            CHECK(theirs[i].end == ours[i].end);
            CHECK(theirs[i].duration == ours[i].duration);
            CHECK(theirs[i].place.has_value() == ours[i].place.has_value());
            if (ours[i].place) {
                CHECK(theirs[i].place->x_px == Approx(ours[i].place->x_px).margin(5e-4));
                CHECK(theirs[i].place->y_px == Approx(ours[i].place->y_px).margin(5e-4));
            }
        }
    }
}

TEST_CASE("events of an imported recording without any are found only when that is asked for", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path session = record_session(root.path() / "sessions", EventSettings{});
    export_asc(SessionRecord(session), root.path() / "asc");
    // Without its events: as samples alone.
    const std::string whole = text_of(root.path() / "asc" / "sub-AB7_ses-01_run-01.asc");
    std::istringstream lines(whole);
    std::ofstream bare(root.path() / "bare.asc");
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("SFIX") && !line.starts_with("EFIX") && !line.starts_with("SSACC") &&
            !line.starts_with("ESACC") && !line.starts_with("SBLINK") && !line.starts_with("EBLINK"))
            bare << line << '\n';
    bare.close();
    AscImportOptions into;
    into.place = {root.path(), "bare", "1"};
    into.out = root.path() / "bare";
    import_asc(root.path() / "bare.asc", into);
    SessionRecord record(root.path() / "bare");
    CHECK(record.event_origin(1).from == From::nobody);
    CHECK(eye_events(record, 0).empty());
    CHECK(record.event_origins().empty());
    record.detect_events_of_imports();
    CHECK(record.event_origin(1).from == From::reading);
    // Places have three decimals in ASC.
    const std::vector<GazeEvent> found = eye_events(record, 0),
                                 expected = expected_events(0, record.event_origin(1).settings);
    CHECK(agreement(GazeEvent::Kind::fixation, expected, found).f1() == 1.0);
    CHECK(agreement(GazeEvent::Kind::saccade, expected, found).f1() == 1.0);
}
