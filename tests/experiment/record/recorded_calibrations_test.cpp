/// Calibrations and what a tracker says besides samples: in the record, in its seals, and in the exports.
#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>
#include <nlohmann/json.hpp>

#include "experiment/base/whole_file.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/bids/bids_tracker.h"
#include "experiment/record/read/recorded_validation.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_readers.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;

namespace {

RecordedCalibration of_both_eyes() {
    RecordedCalibration calibration;
    calibration.at = at_ms(500);
    calibration.method = "polynomial of second order, 9 targets";
    calibration.is_within_limits = false;
    calibration.validation.mean_error = {0.5};
    calibration.validation.max_error = {1.0};
    calibration.validation.targets = {
        {Eye::left, {100.0, 200.0}, ScreenPoint{104.0, 197.0}, {0.25}, Degrees{0.05}, Degrees{0.1}},
        {Eye::right, {100.0, 200.0}, ScreenPoint{110.0, 200.0}, {0.5}, {}, {}},
        {Eye::left, {900.0, 800.0}, ScreenPoint{900.0, 790.5}, {0.75}, {}, {}},
        {Eye::right, {900.0, 800.0}, std::nullopt, {0.0}, {}, {}}};
    return calibration;
}

struct RecordedSetups {
    test::TemporaryFolder root;
    std::filesystem::path session;

    RecordedSetups() {
        SessionHeader header = eye_session_header();
        header.tracker.both_eyes = true;
        header.schedule.observer.label = "AB7";
        session = make_session(root.path(), header);
        SessionStore store(session / session_file_name, patient());
        for (const std::int64_t second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second), TrackerTime(std::chrono::seconds(second)), at_ms(1000 * second)});
        store.calibration(of_both_eyes());
        const Trial& trial = header.schedule.trials[0];
        store.tracker_item(trial.index, TrackerInput{tracker_time(1), 1}); // before the trial: not kept
        store.trial_started(trial, at_ms(1000));
        for (int i = 0; i < 50; ++i) {
            for (const Eye eye : {Eye::left, Eye::right}) {
                GazeSample sample;
                sample.sampled_at = tracker_time(2'000'000 + 1000 * i);
                sample.eye = eye;
                sample.gaze = ScreenPoint{500.0 + i, eye == Eye::left ? 300.0 : 301.0};
                sample.pupil_area = 900.0f;
                store.sample(trial.index, sample);
                store.tracker_item(trial.index,
                                   SampleDetail{sample.sampled_at, eye, 0.5f, glm::vec3(1.0f, 2.0f, 600.5f)});
            }
        }
        store.tracker_item(trial.index, TrackerInput{tracker_time(2'010'000), 255});
        store.tracker_item(trial.index, TrackerButton{tracker_time(2'020'000), 3, true});
        store.tracker_item(trial.index,
                           TrackerGap{TrackerGap::Reason::overflow, tracker_time(2'030'000), 12});
        TrackerEvent fixation;
        fixation.eye = Eye::left;
        fixation.start = tracker_time(2'000'000);
        fixation.end = tracker_time(2'040'000);
        fixation.duration = std::chrono::milliseconds(41);
        fixation.place = ScreenPoint{520.0, 300.0};
        fixation.pupil = 900.0f;
        store.tracker_item(trial.index, fixation);
        store.trial_finished(trial, outcome_at(1000));
        store.close();
    }
};

} // namespace

TEST_CASE("a calibration comes back from the record as it went in", "[unit]") {
    const RecordedSetups recorded;
    const SessionRecord record(recorded.session);
    const std::vector<RecordedCalibration> all = record.calibrations(1);
    REQUIRE(all.size() == 1);
    const RecordedCalibration& found = all[0];
    const RecordedCalibration put = of_both_eyes();
    CHECK(found.at == put.at);
    CHECK(found.trial == -1);
    CHECK(found.method == put.method);
    CHECK_FALSE(found.is_within_limits);
    CHECK(found.validation.mean_error == put.validation.mean_error);
    CHECK(found.validation.max_error == put.validation.max_error);
    REQUIRE(found.validation.targets.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        const ValidatedTarget &a = found.validation.targets[i], &b = put.validation.targets[i];
        CHECK(a.eye == b.eye);
        CHECK(a.target == b.target);
        CHECK(a.gaze == b.gaze);
        CHECK(a.error == b.error);
        CHECK(a.rms_s2s == b.rms_s2s);
        CHECK(a.sd == b.sd);
    }
    CHECK(record.calibrations(2).empty());
}

TEST_CASE("of each eye a validation has its own mean and largest error", "[unit]") {
    const ValidationResult both = of_both_eyes().validation;
    const ValidationOfEye left = validation_of_eye(both, Eye::left),
                          right = validation_of_eye(both, Eye::right);
    CHECK(left.mean_error.value == 0.5);
    CHECK(left.max_error.value == 0.75);
    CHECK(left.targets.size() == 2);
    CHECK(right.mean_error.value == 0.5); // of the one target that was seen
    CHECK(right.max_error.value == 0.5);
    CHECK(validation_of_eye({{0.3}, {0.7}}, Eye::left).max_error.value == 0.7);
}

TEST_CASE("inputs, buttons, gaps and the tracker's own events stand among the trial's gaze events",
          "[unit]") {
    const RecordedSetups recorded;
    const SessionRecord record(recorded.session);
    std::vector<GazeEvent> events;
    record.read_gaze_events(record.trials().at(0), [&](const GazeEvent& event) { events.push_back(event); });
    REQUIRE(events.size() == 4);
    CHECK(events[0].kind == GazeEvent::Kind::input);
    CHECK(events[0].text == "255");
    CHECK(events[1].kind == GazeEvent::Kind::button);
    CHECK(events[1].text == "3 1");
    CHECK(events[2].kind == GazeEvent::Kind::note);
    CHECK(events[2].text == "data lost (queue overflow): 12 samples");
    CHECK(events[2].start == tracker_time(2'030'000));
    CHECK(events[3].kind == GazeEvent::Kind::fixation);
    CHECK(events[3].eye == Eye::left);
    CHECK(events[3].duration == std::chrono::milliseconds(41));
    CHECK(events[3].place == ScreenPoint{520.0, 300.0});
    CHECK(events[3].pupil == 900.0);
    CHECK(record.event_origin(1).from == SessionRecord::EventOrigin::From::tracker);
    SQLite::Database database((recorded.session / session_file_name).string());
    SQLite::Statement details(
        database, "SELECT COUNT(*), MIN(confidence), MAX(eye_z_mm), MIN(eye), MAX(eye) FROM sample_detail");
    REQUIRE(details.executeStep());
    CHECK(details.getColumn(0).getInt() == 100);
    CHECK(details.getColumn(1).getDouble() == 0.5);
    CHECK(details.getColumn(2).getDouble() == 600.5);
    CHECK(details.getColumn(3).getInt() == 0);
    CHECK(details.getColumn(4).getInt() == 1);
}

TEST_CASE("ASC and BIDS tell of each eye's validation and its targets", "[unit]") {
    const RecordedSetups recorded;
    const SessionRecord record(recorded.session);
    const test::TemporaryFolder out;
    export_asc(record, out.path() / "asc");
    const std::string text = read_whole_file(out.path() / "asc/sub-AB7_ses-01_run-01.asc");
    CHECK_THAT(text, Contains("!CAL VALIDATION HV2 L LEFT  ERROR 0.50 avg. 0.75 max\n"));
    CHECK_THAT(text, Contains("!CAL VALIDATION HV2 R RIGHT  ERROR 0.50 avg. 0.50 max\n"));
    CHECK_THAT(text, Contains("VALIDATE L 2POINT 0 LEFT  at 100,200  OFFSET 0.25 deg.  4.0,-3.0 pix.\n"));
    CHECK_THAT(text, Contains("VALIDATE R 2POINT 1 RIGHT  at 900,800  MISSING\n"));
    CHECK(read_as_mne(text).failure == "");
    // What the program took down of the tracker is a message, once: a line without a time is no ASC.
    CHECK_THAT(text, Contains("MSG\t2030 data lost (queue overflow): 12 samples\n"));
    CHECK(text.find("data lost") == text.rfind("data lost"));
    const nlohmann::ordered_json left = bids_tracker(record, 1, Eye::left);
    CHECK(left["CalibrationCount"] == 1);
    // The calibration had nine targets, and where they were is not on record; the validation had these two.
    CHECK(left["CalibrationType"] == "HV9");
    CHECK_FALSE(left.contains("CalibrationPosition"));
    CHECK(left["ValidationUnit"] == "pixel");
    CHECK(left["ValidationPosition"] == nlohmann::ordered_json::parse("[[100.0, 200.0], [900.0, 800.0]]"));
    CHECK_THAT(text, Contains(">>>>>>> CALIBRATION (HV9,"));
    CHECK(left["AverageCalibrationError"] == 0.5);
    CHECK(left["MaximalCalibrationError"] == 0.75);
    CHECK(bids_tracker(record, 1, Eye::right)["MaximalCalibrationError"] == 0.5);
}
