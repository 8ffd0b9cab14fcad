/// Datasets of imported recordings, and what datasets say of trackers.
#include "experiment/base/error.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/bids/bids_tracker.h"
#include "tests/experiment/record/bids/bids_bench.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::bids_bench;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("an imported recording becomes a dataset with the tracker's own events", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    example.right = true;
    AscImportOptions options;
    options.place = {root.path(), "reading", "P1"};
    options.screen_mm = glm::dvec2(400.0, 300.0);
    const fs::path file = write_asc(root.path() / "a.asc", asc_text(example));
    const AscImportSummary without_distance = import_asc(file, options);
    CHECK_THROWS_WITH(
        export_bids(SessionRecord(without_distance.session), without_surface, root.path() / "no", {}),
        Contains("--distance-mm"));
    CHECK_FALSE(fs::exists(root.path() / "no"));
    options.viewing_distance_mm = 600.0;
    const SessionRecord record(import_asc(file, options).session);
    const BidsExportCounts counts = export_bids(record, without_surface, root.path() / "dataset", {});
    CHECK(counts.recordings == 2);
    const BidsRules rules(root.path() / "dataset");
    CHECK(rules.text() == "");
    const std::string rows = unpacked(root.path() / "dataset" / "sub-P1" / "ses-02" / "beh" /
                                      "sub-P1_ses-02_task-reading_run-01_recording-eye1_physioevents.tsv.gz");
    CHECK_THAT(rows, Contains("5030000\t0.010000\tfixation\tn/a\tn/a\t512.800\t394.500"));
    CHECK_THAT(rows, Contains("\tsaccade\t1\t"));
    CHECK_THAT(rows, Contains("TRIALID 1"));
    const auto json =
        nlohmann::json::parse(bytes_of(root.path() / "dataset" / "sub-P1" / "ses-02" / "beh" /
                                       "sub-P1_ses-02_task-reading_run-01_recording-eye1_physio.json"));
    CHECK(json["AverageCalibrationError"] == 0.31);
    CHECK(json["CalibrationType"] == "HV3");
    CHECK(json["Manufacturer"] == "SR Research");
    CHECK(json["EyeTrackingMethod"] == "P-CR");
    // The task is what it was imported as, and not the file; and nobody says what was shown, nor by what.
    CHECK(json["TaskName"] == "reading");
    for (const auto& [name, text] : content_of(root.path() / "dataset")) {
        INFO(name);
        CHECK(text.find("object\"s") == std::string::npos);
        CHECK(text.find("animated") == std::string::npos);
        CHECK(text.find("a.asc") == std::string::npos);
        CHECK((name.find("_events.json") == std::string::npos ||
               text.find("SoftwareName") == std::string::npos));
    }
}

TEST_CASE("how an imported recording tracked is what it says itself", "[unit]") {
    const auto method_of = [](const std::string& from, const std::string& to) {
        const test::TemporaryFolder root;
        AscImportOptions options;
        options.place = {root.path(), "reading", "P1"};
        std::string text = asc_text({});
        for (std::size_t at = text.find(from); !from.empty() && at != std::string::npos;
             at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        const SessionRecord record(import_asc(write_asc(root.path() / "a.asc", text), options).session);
        return bids_tracker(record, 1, Eye::left).value("EyeTrackingMethod", "");
    };
    CHECK(method_of("", "") == "P-CR");
    CHECK(method_of("RECCFG CR", "RECCFG P") == "pupil alone");
    CHECK(method_of(" RECCFG ", " OTHER ") == "");
}

TEST_CASE("a calibration whose targets nobody counted has no type", "[unit]") {
    const auto type_of = [](const std::string& type) {
        const test::TemporaryFolder root;
        AscImportOptions options;
        options.place = {root.path(), "reading", "P1"};
        std::string text = asc_text({});
        const std::string own = "(HV3,";
        for (std::size_t at = text.find(own); at != std::string::npos; at = text.find(own, at + 1))
            text.replace(at, own.size(), "(" + type + ",");
        const SessionRecord record(import_asc(write_asc(root.path() / "a.asc", text), options).session);
        return bids_tracker(record, 1, Eye::left).value("CalibrationType", "none");
    };
    CHECK(type_of("HV9") == "HV9");
    CHECK(type_of("HV0") == "none"); // as a program before this one wrote it
}

TEST_CASE("a dataset says of the pupil and the tracker what each tracker measures", "[unit]") {
    struct Case {
        std::string name, model, pupil, unit, manufacturer, method;
    };
    const Case cases[] = {
        {"eyelink", "", "Pupil area", "arbitrary", "SR Research", "P-CR"},
        {"tobii", "", "Pupil diameter", "mm", "Tobii", "P-CR"},
        {"Open Gaze", "", "Pupil diameter", "mm", "Gazepoint", "P-CR"},
        {"Pupil Core", "", "Pupil diameter", "mm", "Pupil Labs", "pupil alone, by a model of the eye"},
        {"replay", "gaze of sub-07_ses-01, by tobii", "Pupil diameter", "mm", "Tobii", "P-CR"},
        {"Lab Streaming Layer", "", "whether it is an area or a diameter", "arbitrary", "", ""},
    };
    for (const Case& of : cases) {
        CAPTURE(of.name);
        const test::TemporaryFolder root;
        SessionHeader header = eye_session_header();
        header.tracker.name = of.name;
        header.tracker.model = of.model;
        const fs::path session = make_session(root.path(), header);
        {
            SessionStore store(session / session_file_name, patient());
            for (const std::int64_t second : {0, 100})
                store.clock_pair(
                    {at_ms(1000 * second), TrackerTime(std::chrono::seconds(second)), at_ms(1000 * second)});
            record_attempt(store, 0, header.schedule.trials[0], 1000, 200, TrialOutcome::Status::completed);
        }
        export_bids(SessionRecord(session), without_surface, root.path() / "dataset", {});
        const auto json =
            nlohmann::json::parse(bytes_of(root.path() / "dataset/sub-AB7/ses-01/beh" / (physio + ".json")));
        CHECK_THAT(json["pupil_size"]["Description"].get<std::string>(), Contains(of.pupil));
        CHECK(json["pupil_size"]["Units"] == of.unit);
        CHECK(json.value("Manufacturer", "") == of.manufacturer);
        CHECK(json.value("EyeTrackingMethod", "") == of.method);
        CHECK(BidsRules(root.path() / "dataset").text() == "");
    }
}
