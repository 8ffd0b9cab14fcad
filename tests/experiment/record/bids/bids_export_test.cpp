#include "experiment/record/bids/bids_export.h"

#include <algorithm>
#include <utility>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/number_text.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/bids/bids_tracker.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_text.h"
#include "tests/support/bids_rules.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

const SurfaceLookup* no_surface(const ViewedObject&) { return nullptr; }

struct Dataset {
    test::TemporaryFolder root;
    fs::path path = root.path() / "dataset";
    BidsExportCounts counts;

    Dataset() { counts = add("AB7"); }
    BidsExportCounts add(const std::string& observer, bool overwrite = false) {
        const fs::path sessions = root.path() / "sessions";
        const fs::path session = fs::exists(sessions / "tiny" / ("sub-" + observer + "_ses-01"))
                                     ? sessions / "tiny" / ("sub-" + observer + "_ses-01")
                                     : make_eye_session(sessions, observer);
        return export_bids(SessionRecord(session), no_surface, path, {overwrite, false, {}});
    }
    fs::path beh(const std::string& file) const { return path / "sub-AB7" / "ses-01" / "beh" / file; }
    nlohmann::json json(const fs::path& file) const { return nlohmann::json::parse(bytes_of(file)); }
};

const std::string physio = "sub-AB7_ses-01_task-tiny_run-01_recording-eye1_physio";
const std::string gaze_events = "sub-AB7_ses-01_task-tiny_run-01_recording-eye1_physioevents";
const std::string events_file = "sub-AB7_ses-01_task-tiny_run-01_events";

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

void write_packed(const fs::path& file, const std::string& text, bool with_name = false) {
    if (with_name) {
        const gzFile stream = gzopen(file.c_str(), "wb");
        gzwrite(stream, text.data(), static_cast<unsigned>(text.size()));
        gzclose(stream);
        std::string bytes = bytes_of(file);
        bytes[4] = 1;
        write(file, bytes);
        return;
    }
    fs::remove(file);
    OutputFile out(file, Packing::gzip);
    out.text() = text;
    out.close();
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::map<std::string, std::string> content_of(const fs::path& folder) {
    std::map<std::string, std::string> content;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            content[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
    return content;
}

} // namespace

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
        file.extension() == ".gz" ? write_packed(file, broken.text) : write(file, broken.text);
        CHECK(BidsRules(dataset.path).breaks(broken.rule));
        write(file, before);
    }
    const std::string packed = bytes_of(dataset.beh(physio + ".tsv.gz"));
    write_packed(dataset.beh(physio + ".tsv.gz"), samples, true);
    CHECK(BidsRules(dataset.path).breaks("GZIP_HEADER"));
    write(dataset.beh(physio + ".tsv.gz"), packed);
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

TEST_CASE("the samples of a dataset are those of the session, in the tracker's own time, row by row with "
          "their places",
          "[unit]") {
    const Dataset dataset;
    const SessionRecord record(dataset.root.path() / "sessions" / "tiny" / "sub-AB7_ses-01");
    std::string expected;
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == 1)
            for (const GazeSample& sample : record.samples(trial)) {
                expected += fmt::format("{}\t", sample.sampled_at.time_since_epoch().count());
                if (!sample.gaze) {
                    expected += "n/a\tn/a\tn/a\n";
                    continue;
                }
                append_fixed(expected, sample.gaze->x_px, 3);
                append_fixed(expected += '\t', sample.gaze->y_px, 3);
                append_fixed(expected += '\t', static_cast<double>(sample.pupil_area), 4);
                expected += '\n';
            }
    const std::string samples = unpacked(dataset.beh(physio + ".tsv.gz"));
    CHECK((samples == expected));
    const std::string places =
        unpacked(dataset.path / "derivatives" / "overt" / "sub-AB7" / "ses-01" / "beh" /
                 "sub-AB7_ses-01_task-tiny_acq-surface_run-01_recording-eye1_physio.tsv.gz");
    CHECK(std::count(places.begin(), places.end(), '\n') == std::count(samples.begin(), samples.end(), '\n'));
    CHECK(places.substr(0, samples.find('\t', samples.find('\t') + 1)) ==
          samples.substr(0, samples.find('\t', samples.find('\t') + 1)));
    CHECK(dataset.json(dataset.beh(physio + ".json"))["AverageCalibrationError"] == 0.312);
    CHECK(dataset.json(dataset.beh(physio + ".json"))["MaximalCalibrationError"] == 0.754);
    CHECK(dataset.json(dataset.beh(physio + ".json"))["CalibrationCount"] == 1);
    CHECK_THAT(bytes_of(dataset.beh(events_file + ".tsv")), Contains("\tSchauen Sie sich um; ganz frei\t"));
    CHECK(dataset.json(dataset.beh(physio + ".json"))["StartTime"] == 0.0);
    // The first sample was taken 900.137 ms after its trial's begin: so the trial's onset is that much
    // earlier.
    const std::string rows = bytes_of(dataset.beh(events_file + ".tsv"));
    CHECK_THAT(rows, Contains("\n-0.900137000\t4.000000000\ttrial\t"));
    CHECK_THAT(rows, Contains("\taborted\t"));
    CHECK_THAT(rows, Contains("vierzig, \"oder\"\\tfünfzig"));
}

TEST_CASE("sessions join a dataset one by one and change nothing of the others", "[unit]") {
    Dataset dataset;
    auto before = content_of(dataset.path);
    dataset.add("C2");
    auto after = content_of(dataset.path);
    for (const auto& [file, content] : before)
        if (!file.starts_with("participants."))
            CHECK(after[file] == content);
    CHECK_THAT(after["participants.tsv"], Contains("\nsub-AB7\t") && Contains("\nsub-C2\t"));
    CHECK_THROWS_WITH(dataset.add("C2"), Contains("holds this session already"));
    CHECK(content_of(dataset.path) == after);
    CHECK_NOTHROW(dataset.add("C2", true));
    CHECK(content_of(dataset.path) == after);
    // What somebody wrote into the table of observers stays.
    write(dataset.path / "participants.tsv",
          "participant_id\tage\tglasses\nsub-AB7\t33\tyes\nsub-C2\t44\tno\n");
    dataset.add("D3");
    CHECK_THAT(bytes_of(dataset.path / "participants.tsv"),
               Contains("sub-AB7\t33\tyes") && Contains("sub-D3\t34\tn/a"));
    int hidden = 0;
    for (const auto& entry : fs::directory_iterator(dataset.root.path()))
        hidden += entry.path().filename().string().starts_with(".");
    CHECK(hidden == 0);
}

TEST_CASE("two exports that begin a dataset at once both stand in it", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path dataset = root.path() / "dataset";
    const SessionRecord first(make_eye_session(root.path() / "sessions", "AB7")),
        second(make_eye_session(root.path() / "sessions", "C2"));
    bool began = false;
    // The second one runs from its begin to its end while the first has not yet given the dataset its name.
    export_bids(first, no_surface, dataset, {false, false, [&](int, int) {
                                                 if (!std::exchange(began, true))
                                                     export_bids(second, no_surface, dataset, {});
                                             }});
    CHECK(BidsRules(dataset).text() == "");
    CHECK_THAT(bytes_of(dataset / "participants.tsv"), Contains("\nsub-AB7\t") && Contains("\nsub-C2\t"));
    Dataset alone;
    auto both = content_of(dataset);
    for (const auto& [file, content] : content_of(alone.path))
        if (!file.starts_with("participants."))
            CHECK(both[file] == content);
}

TEST_CASE("the observer's form stands in the table of participants, in words that BIDS knows", "[unit]") {
    Dataset dataset;
    const std::string rows = bytes_of(dataset.path / "participants.tsv");
    CHECK(rows == "participant_id\tspecies\tage\tsex\thandedness\tvision\n"
                  "sub-AB7\thomo sapiens\t34\tfemale\tn/a\tmit\\tBrille\n");
    const auto json = dataset.json(dataset.path / "participants.json");
    CHECK(json["vision"]["Description"] == "Sehen, 視力");
    CHECK(json["age"]["Units"] == "year");
    REQUIRE(dataset.counts.remarks.size() == 1);
    CHECK_THAT(dataset.counts.remarks[0], Contains("handedness is \"beide\""));
    // The same observer once more, a year older: the table stays, and it is said.
    const fs::path session = make_eye_session(dataset.root.path() / "later");
    {
        SessionStore store(session / session_file_name, patient());
        store.observer_fields({{"age", "Alter", "35"}});
        store.close();
    }
    const auto counts = export_bids(SessionRecord(session), no_surface, dataset.path, {true, false, {}});
    CHECK(bytes_of(dataset.path / "participants.tsv") == rows);
    CHECK_THAT(counts.remarks.back(), Contains("age is 34 in participants.tsv, and 35 in this session"));
}

TEST_CASE("what the protocol says of its dataset describes it and its derivative, and where it was recorded",
          "[unit]") {
    Dataset dataset;
    SessionHeader header = eye_session_header();
    header.dataset = {{"name", "Sehen 見る"},
                      {"authors", "A. Author"},
                      {"authors", "B. Author"},
                      {"license", "CC0"},
                      {"funding", "Fund 1"},
                      {"ethics_approvals", "Board, 12/34"},
                      {"doi", "10.1234/abc"},
                      {"references", "doi:10.1/x"},
                      {"keywords", "gaze"},
                      {"how_to_acknowledge", "Cite it."},
                      {"acknowledgements", "Thanks."},
                      {"institution_name", "Colourlab"},
                      {"department", "IDI"}};
    const fs::path session = make_eye_session(dataset.root.path() / "described", "C1", header);
    CHECK(SessionRecord(session).header().dataset == header.dataset);
    const fs::path out = dataset.root.path() / "described_dataset";
    export_bids(SessionRecord(session), no_surface, out);
    CHECK(BidsRules(out).text() == "");
    const auto raw = dataset.json(out / "dataset_description.json"),
               derived = dataset.json(out / "derivatives" / "overt" / "dataset_description.json");
    for (const auto& json : {raw, derived}) {
        CHECK(json["Authors"] == nlohmann::json({"A. Author", "B. Author"}));
        CHECK(json["License"] == "CC0");
        CHECK(json["Funding"] == nlohmann::json({"Fund 1"}));
        CHECK(json["EthicsApprovals"] == nlohmann::json({"Board, 12/34"}));
        CHECK(json["ReferencesAndLinks"] == nlohmann::json({"doi:10.1/x"}));
        CHECK(json["Keywords"] == nlohmann::json({"gaze"}));
        CHECK(json["HowToAcknowledge"] == "Cite it.");
        CHECK(json["Acknowledgements"] == "Thanks.");
    }
    CHECK(raw["Name"] == "Sehen 見る");
    CHECK(derived["Name"] == "Sehen 見る: places on the surface");
    CHECK(raw["DatasetDOI"] == "doi:10.1234/abc");
    CHECK_FALSE(derived.contains("DatasetDOI"));
    CHECK(derived["SourceDatasets"][0]["DOI"] == "doi:10.1234/abc");
    const auto of_events =
        dataset.json(out / "sub-C1" / "ses-01" / "beh" / "sub-C1_ses-01_task-tiny_run-01_events.json");
    CHECK(of_events["InstitutionName"] == "Colourlab");
    CHECK(of_events["InstitutionalDepartmentName"] == "IDI");
    CHECK_FALSE(of_events.contains("InstitutionAddress"));
}

TEST_CASE("spoken answers are left out of a dataset and counted, or copied beside it when asked", "[unit]") {
    Dataset dataset;
    const fs::path session = make_eye_session(dataset.root.path() / "spoken", "D1");
    fs::create_directories(session / "answers");
    write(session / "answers" / "one.wav", "a voice");
    {
        SessionStore store(session / session_file_name, patient());
        record_attempt(store, 2, eye_session_header().schedule.trials[3], 70'000, 40,
                       TrialOutcome::Status::completed);
        RecordedAnswer answer;
        answer.trial = eye_session_header().schedule.trials[3].index;
        answer.file = "answers/one.wav";
        answer.sample_rate_hz = 48000.0;
        answer.onset_sample = 12.5;
        store.answer_recorded(answer);
        store.close();
    }
    const fs::path out = dataset.root.path() / "spoken_dataset";
    const auto is_wav = [&](const fs::path& file) { return file.extension() == ".wav"; };
    const auto wavs = [&] {
        const auto files = fs::recursive_directory_iterator(out);
        return std::count_if(begin(files), end(files),
                             [&](const auto& entry) { return is_wav(entry.path()); });
    };
    const BidsExportCounts without = export_bids(SessionRecord(session), no_surface, out);
    CHECK(wavs() == 0);
    CHECK_FALSE(fs::exists(out / "sourcedata"));
    CHECK(std::any_of(without.remarks.begin(), without.remarks.end(), [](const std::string& remark) {
        return remark.find("--with-answers") != std::string::npos;
    }));
    export_bids(SessionRecord(session), no_surface, out, {true, true, {}});
    CHECK(BidsRules(out).text() == "");
    REQUIRE(wavs() == 1);
    const fs::path folder = out / "sourcedata" / "sub-D1" / "ses-01" / "beh";
    const std::string table = bytes_of(folder / "sub-D1_ses-01_task-tiny_run-03_answers.tsv");
    CHECK_THAT(table, Contains("12.500\t48000"));
    const std::string file = table.substr(table.find('\n') + 1, table.find(".wav") + 3 - table.find('\n'));
    CHECK(bytes_of(folder / file) == "a voice");
    // Without them once more: what was copied goes.
    export_bids(SessionRecord(session), no_surface, out, {true, false, {}});
    CHECK(wavs() == 0);
}

TEST_CASE("a folder that is no dataset of ours is left alone", "[unit]") {
    Dataset dataset;
    const fs::path other = dataset.root.path() / "other";
    fs::create_directories(other);
    write(other / "thesis.txt", "years of work");
    const SessionRecord record(dataset.root.path() / "sessions" / "tiny" / "sub-AB7_ses-01");
    CHECK_THROWS_AS(export_bids(record, no_surface, other, {true, false, {}}), InputError);
    write(other / "dataset_description.json", R"({"Name": "x", "GeneratedBy": [{"Name": "somebody"}]})");
    CHECK_THROWS_AS(export_bids(record, no_surface, other, {true, false, {}}), InputError);
    CHECK(content_of(other).size() == 2);
}

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
        export_bids(SessionRecord(without_distance.session), no_surface, root.path() / "no", {}),
        Contains("--distance-mm"));
    CHECK_FALSE(fs::exists(root.path() / "no"));
    options.viewing_distance_mm = 600.0;
    const SessionRecord record(import_asc(file, options).session);
    const BidsExportCounts counts = export_bids(record, no_surface, root.path() / "dataset", {});
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
        export_bids(SessionRecord(session), no_surface, root.path() / "dataset", {});
        const auto json =
            nlohmann::json::parse(bytes_of(root.path() / "dataset/sub-AB7/ses-01/beh" / (physio + ".json")));
        CHECK_THAT(json["pupil_size"]["Description"].get<std::string>(), Contains(of.pupil));
        CHECK(json["pupil_size"]["Units"] == of.unit);
        CHECK(json.value("Manufacturer", "") == of.manufacturer);
        CHECK(json.value("EyeTrackingMethod", "") == of.method);
        CHECK(BidsRules(root.path() / "dataset").text() == "");
    }
}
