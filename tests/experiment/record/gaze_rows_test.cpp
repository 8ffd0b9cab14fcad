#include "experiment/record/gaze_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/record/header_rows.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

/// A session's file with two sittings, in memory of this test.
struct OpenFile {
    OpenFile() : database(made(root), SQLite::OPEN_READWRITE) {
        database.exec("INSERT INTO sitting (sitting, started_utc, closed) VALUES (1, '', 1), (2, '', 1)");
    }
    static std::string made(const TemporaryFolder& root) {
        create_session_file(root.path() / "a.sqlite", example_header());
        return (root.path() / "a.sqlite").string();
    }
    std::string rows(const std::string& select) {
        std::string text;
        SQLite::Statement row(database, select);
        while (row.executeStep()) {
            for (int column = 0; column < row.getColumnCount(); ++column)
                text += (column == 0 ? "" : "|") + row.getColumn(column).getString();
            text += "\n";
        }
        return text;
    }
    TemporaryFolder root;
    SQLite::Database database;
};

GazeEvent saccade() {
    GazeEvent event;
    event.kind = GazeEvent::Kind::saccade;
    event.eye = Eye::left;
    event.start = tracker_time(1001);
    event.end = tracker_time(1042);
    event.duration = TrackerClock::duration(43);
    event.place = ScreenPoint{1.5, 2.5};
    event.arrival = ScreenPoint{3.5, 4.5};
    event.pupil = 5.5;
    event.amplitude_deg = 6.5;
    event.peak_velocity_deg_s = 7.5;
    event.text = "a saccade";
    return event;
}

} // namespace

TEST_CASE("a tracker's events stand in their columns, and come back trial by trial", "[unit]") {
    OpenFile file;
    GazeEvent message;
    message.text = "before all";
    GazeEvent later = message;
    later.text = "before all, too";
    GazeEvent right = saccade();
    right.eye = Eye::right;
    {
        GazeRows rows(file.database);
        rows.event(message); // before the first trial
        rows.begin_trial(1);
        rows.event(saccade());
        rows.event(message);
        rows.begin_trial(2);
        rows.event(right);
        rows.begin_trial(0); // and again: what is there already stays
        rows.event(later);
    }
    CHECK(file.rows("SELECT * FROM gaze_event WHERE trial_id = 1 AND n = 0") ==
          "1|0|saccade|0|1001|1042|43|1.5|2.5|3.5|4.5|5.5|6.5|7.5|a saccade\n");
    CHECK(file.rows("SELECT trial_id, n, eye FROM gaze_event ORDER BY trial_id, n") ==
          "0|0|\n0|1|\n1|0|0\n1|1|\n2|0|1\n");
    const auto events_of = [&](std::int64_t trial) {
        std::vector<GazeEvent> events;
        read_gaze_events(file.database, trial, [&](const GazeEvent& event) { events.push_back(event); });
        return events;
    };
    CHECK(events_of(0) == std::vector{message, later});
    CHECK(events_of(1) == std::vector{saccade(), message});
    CHECK(events_of(2) == std::vector{right});
    CHECK(events_of(3).empty());
    // Half a place is none.
    file.database.exec("UPDATE gaze_event SET y_px = NULL, arrival_x_px = NULL WHERE trial_id = 2");
    CHECK_FALSE(events_of(2).at(0).place);
    CHECK_FALSE(events_of(2).at(0).arrival);
}

TEST_CASE("samples and what a tracker says besides of them are counted from 0 in each trial", "[unit]") {
    OpenFile file;
    {
        GazeRows rows(file.database);
        for (const std::int64_t trial : {1, 2}) {
            rows.begin_trial(trial);
            for (int i = 0; i < 2; ++i) {
                rows.sample({tracker_time(10 * trial + i), i == 0 ? Eye::left : Eye::right,
                             i == 0 ? std::optional(ScreenPoint{0.25, 0.75}) : std::nullopt, 0.1f});
                rows.detail({tracker_time(10 * trial + i), i == 0 ? Eye::left : Eye::right,
                             i == 0 ? std::optional(0.3f) : std::nullopt,
                             i == 0 ? std::nullopt : std::optional(glm::vec3(0.1f, 0.2f, 0.7f))});
            }
        }
    }
    CHECK(file.rows("SELECT * FROM sample ORDER BY trial_id, n") ==
          "1|0|10|0|0.25|0.75|0.1\n1|1|11|1|||0.1\n2|0|20|0|0.25|0.75|0.1\n2|1|21|1|||0.1\n");
    CHECK(file.rows("SELECT * FROM sample_detail ORDER BY trial_id, n") ==
          "1|0|10|0|0.3|||\n1|1|11|1||0.1|0.2|0.7\n2|0|20|0|0.3|||\n2|1|21|1||0.1|0.2|0.7\n");
}

TEST_CASE("the file and the detection of a sitting's gaze come back as they were", "[unit]") {
    OpenFile file;
    GazeRows rows(file.database);
    GazeSource source{"a.asc", std::string(64, 'a'), "** one\n** two", true, 500.0, true, true, 31.5, 32.5,
                      7};
    const auto eyes = [&](bool left, bool right) {
        source.has_left = left;
        source.has_right = right;
        rows.source(1, source);
        const GazeSource read = read_gaze_source(file.database, 1).value();
        return std::pair(read.has_left, read.has_right);
    };
    CHECK(eyes(true, false) == std::pair(true, false));
    CHECK(eyes(false, true) == std::pair(false, true));
    CHECK(eyes(true, true) == std::pair(true, true));
    CHECK(file.rows("SELECT * FROM gaze_source") ==
          "1|a.asc|" + std::string(64, 'a') + "|** one\n** two|diameter|500.0|both|31.5|32.5|7\n");
    const GazeSource read = read_gaze_source(file.database, 1).value();
    CHECK(read.file == source.file);
    CHECK(read.sha256 == source.sha256);
    CHECK(read.header == source.header);
    CHECK(read.pupil_is_diameter);
    CHECK(read.rate_hz == 500.0);
    CHECK(read.px_per_deg_x == 31.5);
    CHECK(read.px_per_deg_y == 32.5);
    CHECK(read.skipped_lines == 7);
    source.pupil_is_diameter = false;
    rows.source(1, source);
    CHECK_FALSE(read_gaze_source(file.database, 1)->pupil_is_diameter);
    CHECK_FALSE(read_gaze_source(file.database, 2));

    rows.detection(2, {"I-VT", 3, "threshold = 30"});
    const EventDetection detection = read_event_detection(file.database, 2).value();
    CHECK(detection.name == "I-VT");
    CHECK(detection.version == 3);
    CHECK(detection.parameters == "threshold = 30");
    CHECK_FALSE(read_event_detection(file.database, 1));

    rows.line_left_out(2, "line 5: no number");
    CHECK(file.rows("SELECT sitting, at_ns, trial, kind, detail FROM event") ==
          "2|0||line left out|line 5: no number\n");
}

TEST_CASE("calibrations come back sitting by sitting, with each target", "[unit]") {
    OpenFile file;
    GazeRows rows(file.database);
    RecordedCalibration first, second;
    first.at = at_ms(5);
    first.trial = -1;
    first.method = "tracker";
    first.validation = {
        Degrees{0.25},
        Degrees{0.75},
        {{Eye::left, {10.0, 20.0}, ScreenPoint{11.0, 22.0}, Degrees{0.5}, Degrees{0.01}, Degrees{0.02}},
         {Eye::right, {30.0, 40.0}, {}, Degrees{9.0}, {}, {}}}};
    first.is_within_limits = true;
    second = first;
    second.trial = 0;
    second.validation.targets.resize(1);
    second.is_within_limits = false;
    rows.calibration(1, first);
    rows.calibration(2, second);
    CHECK(file.rows("SELECT * FROM calibration ORDER BY id") ==
          "1|1|5000000||tracker|0.25|0.75|1\n2|2|5000000|0|tracker|0.25|0.75|0\n");
    CHECK(file.rows("SELECT * FROM validated_target ORDER BY id") ==
          "1|1|1|0|10.0|20.0|11.0|22.0|0.5|0.01|0.02\n2|1|1|1|30.0|40.0|||||\n"
          "3|2|2|0|10.0|20.0|11.0|22.0|0.5|0.01|0.02\n");
    const auto of_first = read_calibrations(file.database, 1),
               of_second = read_calibrations(file.database, 2);
    REQUIRE(of_first.size() == 1);
    REQUIRE(of_second.size() == 1);
    CHECK(of_first[0].trial == -1);
    CHECK(of_second[0].trial == 0);
    CHECK(of_first[0].at == at_ms(5));
    CHECK(of_first[0].method == "tracker");
    CHECK(of_first[0].is_within_limits);
    CHECK_FALSE(of_second[0].is_within_limits);
    CHECK(of_first[0].validation.mean_error == Degrees{0.25});
    CHECK(of_first[0].validation.max_error == Degrees{0.75});
    REQUIRE(of_first[0].validation.targets.size() == 2);
    CHECK(of_second[0].validation.targets.size() == 1);
    const ValidatedTarget &left = of_first[0].validation.targets[0],
                          &lost = of_first[0].validation.targets[1];
    CHECK(left.eye == Eye::left);
    CHECK(left.target == ScreenPoint{10.0, 20.0});
    CHECK(left.gaze == ScreenPoint{11.0, 22.0});
    CHECK(left.error == Degrees{0.5});
    CHECK(left.rms_s2s == Degrees{0.01});
    CHECK(left.sd == Degrees{0.02});
    CHECK(lost.eye == Eye::right);
    CHECK_FALSE(lost.gaze);
    CHECK(lost.error == Degrees{0.0});
    CHECK_FALSE(lost.sd);
}
