/// Every rule of BIDS is kept, and the checker of the rules finds each of them broken.
#include <algorithm>
#include <utility>

#include "tests/experiment/record/bids/bids_bench.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::bids_bench;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE(
    "a dataset of sessions with blinks, dropped samples, aborted attempts and all kinds of texts keeps every "
    "rule of BIDS",
    "[unit]") {
    Dataset dataset;
    dataset.add("C2");
    const BidsRules rules(dataset.path);
    CHECK(rules.text() == "");
    // Two runs each of one eye, raw and with places.
    CHECK(rules.recordings() == 8);
    CHECK(dataset.counts.runs == 2);
}

TEST_CASE("the checker of the rules finds each of them broken", "[unit]") {
    const Dataset dataset;
    const auto json_without = [&](const std::string& file, const std::vector<std::string>& path) {
        nlohmann::json json = dataset.json(dataset.beh(file));
        nlohmann::json* at = &json;
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
            at = &(*at)[path[i]];
        REQUIRE(at->erase(path.back()) == 1);
        return json.dump();
    };
    const auto json_with = [&](const std::string& file, const std::string& key, const nlohmann::json& value) {
        nlohmann::json json = dataset.json(dataset.beh(file));
        json[key] = value;
        return json.dump();
    };
    const std::string samples = unpacked(dataset.beh(physio + ".tsv.gz"));
    const std::string rows = bytes_of(dataset.beh(events_file + ".tsv"));
    const std::string gaze_rows = unpacked(dataset.beh(gaze_events + ".tsv.gz"));
    const std::string second_line = samples.substr(samples.find('\n') + 1);
    struct Case {
        std::string rule, file, text;
    };
    const std::vector<Case> cases{
        {"START_TIME", physio + ".json", json_without(physio + ".json", {"StartTime"})},
        {"SAMPLING_FREQUENCY", physio + ".json", json_without(physio + ".json", {"SamplingFrequency"})},
        {"RECORDED_EYE", physio + ".json", json_without(physio + ".json", {"RecordedEye"})},
        {"RECORDED_EYE", physio + ".json", json_with(physio + ".json", "RecordedEye", "L")},
        {"PHYSIO_TYPE", physio + ".json", json_without(physio + ".json", {"PhysioType"})},
        {"COORDINATE_SYSTEM", physio + ".json", json_without(physio + ".json", {"SampleCoordinateSystem"})},
        {"COLUMNS", physio + ".json", json_without(physio + ".json", {"Columns"})},
        {"COLUMN_ORDER", physio + ".json",
         json_with(physio + ".json", "Columns", {"x_coordinate", "timestamp", "y_coordinate", "pupil_size"})},
        {"COORDINATE_UNITS", physio + ".json", json_without(physio + ".json", {"x_coordinate", "Units"})},
        {"PUPIL_DESCRIPTION", physio + ".json",
         json_with(physio + ".json", "pupil_size", {{"Description", "how large it is"}})},
        {"COLUMN_UNDESCRIBED", physio + ".json", json_without(physio + ".json", {"pupil_size"})},
        {"HEADER_LINE_OR_BAD_TIME", physio + ".tsv.gz",
         "timestamp\tx_coordinate\ty_coordinate\tpupil_size\n" + samples},
        {"NOT_A_NUMBER", physio + ".tsv.gz", with_replaced(samples, "\tn/a\t", "\tNaN\t")},
        {"NOT_A_NUMBER", physio + ".tsv.gz", with_replaced(samples, "\tn/a\t", "\t.\t")},
        {"ROW_LENGTH", physio + ".tsv.gz", samples + "99999999999\t1.0\n"},
        {"TIMESTAMPS_UNSORTED", physio + ".tsv.gz", second_line + samples},
        {"ONSET_SOURCE", gaze_events + ".json", json_with(gaze_events + ".json", "OnsetSource", "n/a")},
        {"ONSET_SOURCE", gaze_events + ".json", json_without(gaze_events + ".json", {"OnsetSource"})},
        {"ONSET_FIRST", gaze_events + ".json",
         json_with(gaze_events + ".json", "Columns", {"duration", "onset"})},
        {"DURATION_UNITS", gaze_events + ".json",
         json_with(gaze_events + ".json", "duration", {{"Description", "x"}, {"Units", "ms"}})},
        {"EVENTS_UNSORTED", gaze_events + ".tsv.gz", gaze_rows + gaze_rows},
        {"SCREEN_DISTANCE", events_file + ".json",
         json_without(events_file + ".json", {"StimulusPresentation"})},
        {"SCREEN_DISTANCE", events_file + ".json",
         json_without(events_file + ".json", {"StimulusPresentation", "ScreenDistance"})},
        {"SCREEN_ORIGIN", events_file + ".json",
         json_without(events_file + ".json", {"StimulusPresentation", "ScreenOrigin"})},
        {"SCREEN_RESOLUTION", events_file + ".json",
         json_without(events_file + ".json", {"StimulusPresentation", "ScreenResolution"})},
        {"SCREEN_SIZE", events_file + ".json",
         json_without(events_file + ".json", {"StimulusPresentation", "ScreenSize"})},
        {"COLUMN_UNDESCRIBED", events_file + ".json", json_without(events_file + ".json", {"status"})},
        {"VALUE_NOT_IN_LEVELS", events_file + ".tsv", with_replaced(rows, "\tpresentation\t", "\tshow\t")},
        {"ONSET_DURATION_FIRST", events_file + ".tsv",
         with_replaced(rows, "onset\tduration", "duration\tonset")},
        {"EVENTS_UNSORTED", events_file + ".tsv", rows + rows.substr(rows.find('\n') + 1)},
        {"STIMULUS_MISSING", events_file + ".tsv",
         with_replaced(rows, "tiny/bust_silver.png", "tiny/nothing.png")},
        {"EMPTY_CELL", events_file + ".tsv", with_replaced(rows, "\tn/a\t", "\t\t")}};
    for (const Case& broken : cases) {
        CAPTURE(broken.rule, broken.file);
        const fs::path file = dataset.beh(broken.file);
        const std::string before = bytes_of(file);
        file.extension() == ".gz" ? write_packed(file, broken.text) : write_text(file, broken.text);
        CHECK(BidsRules(dataset.path).breaks(broken.rule));
        write_text(file, before);
    }
    const std::string packed = bytes_of(dataset.beh(physio + ".tsv.gz"));
    write_packed(dataset.beh(physio + ".tsv.gz"), samples, true);
    CHECK(BidsRules(dataset.path).breaks("GZIP_HEADER"));
    write_text(dataset.beh(physio + ".tsv.gz"), packed);
    for (const auto& [rule, file] :
         {std::pair{"SIDECAR_MISSING", physio + ".json"}, {"SIDECAR_MISSING", events_file + ".json"}}) {
        fs::rename(dataset.beh(file), dataset.root.path() / "aside");
        CHECK(BidsRules(dataset.path).breaks(rule));
        fs::rename(dataset.root.path() / "aside", dataset.beh(file));
    }
    const std::string nameless = "sub-AB7_ses-01_task-tiny_run-01_physio.tsv.gz";
    fs::copy_file(dataset.beh(physio + ".tsv.gz"), dataset.beh(nameless));
    CHECK(BidsRules(dataset.path).breaks("RECORDING_MISSING"));
    fs::remove(dataset.beh(nameless));
    CHECK(BidsRules(dataset.path).text() == "");
}
