#include "experiment/record/bids/bids_export.h"

#include <algorithm>
#include <utility>

#include "experiment/base/error.h"
#include "experiment/base/number_text.h"
#include "tests/experiment/record/bids/bids_bench.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::bids_bench;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

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
    write_text(dataset.path / "participants.tsv",
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
    export_bids(first, without_surface, dataset, {false, false, [&](int, int) {
                                                 if (!std::exchange(began, true))
                                                     export_bids(second, without_surface, dataset, {});
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
    const auto counts = export_bids(SessionRecord(session), without_surface, dataset.path, {true, false, {}});
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
    export_bids(SessionRecord(session), without_surface, out);
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
    write_text(session / "answers" / "one.wav", "a voice");
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
    const BidsExportCounts without = export_bids(SessionRecord(session), without_surface, out);
    CHECK(wavs() == 0);
    CHECK_FALSE(fs::exists(out / "sourcedata"));
    CHECK(std::any_of(without.remarks.begin(), without.remarks.end(), [](const std::string& remark) {
        return remark.find("--with-answers") != std::string::npos;
    }));
    export_bids(SessionRecord(session), without_surface, out, {true, true, {}});
    CHECK(BidsRules(out).text() == "");
    REQUIRE(wavs() == 1);
    const fs::path folder = out / "sourcedata" / "sub-D1" / "ses-01" / "beh";
    const std::string table = bytes_of(folder / "sub-D1_ses-01_task-tiny_run-03_answers.tsv");
    CHECK_THAT(table, Contains("12.500\t48000"));
    const std::string file = table.substr(table.find('\n') + 1, table.find(".wav") + 3 - table.find('\n'));
    CHECK(bytes_of(folder / file) == "a voice");
    // Without them once more: what was copied goes.
    export_bids(SessionRecord(session), without_surface, out, {true, false, {}});
    CHECK(wavs() == 0);
}

TEST_CASE("a folder that is no dataset of ours is left alone", "[unit]") {
    Dataset dataset;
    const fs::path other = dataset.root.path() / "other";
    fs::create_directories(other);
    write_text(other / "thesis.txt", "years of work");
    const SessionRecord record(dataset.root.path() / "sessions" / "tiny" / "sub-AB7_ses-01");
    CHECK_THROWS_AS(export_bids(record, without_surface, other, {true, false, {}}), InputError);
    write_text(other / "dataset_description.json", R"({"Name": "x", "GeneratedBy": [{"Name": "somebody"}]})");
    CHECK_THROWS_AS(export_bids(record, without_surface, other, {true, false, {}}), InputError);
    CHECK(content_of(other).size() == 2);
}
