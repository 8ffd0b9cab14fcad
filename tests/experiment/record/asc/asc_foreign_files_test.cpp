/// What recordings of other laboratories have that the shipped examples have not.
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/asc/asc_writer.h"
#include "experiment/record/bids/bids_export.h"
#include "experiment/record/tables/table_export.h"
#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_readers.h"
#include "tests/support/asc_text.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::testing;
using test::TsvFile;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

struct Lab {
    test::TemporaryFolder root;
    int files = 0;

    fs::path file(const std::string& text) {
        return write_asc(root.path() / fmt::format("file_{}.asc", ++files), text);
    }
    AscImportSummary import(const AscFiles& recording) {
        AscImportOptions options;
        options.place = {root.path(), "imported", "07"};
        options.out = root.path() / fmt::format("session_{}", ++files);
        options.screen_mm = glm::dvec2(400.0, 300.0);
        options.viewing_distance_mm = 600.0;
        return import_asc(recording, options);
    }
    SessionRecord record(const std::string& text) { return SessionRecord(import(file(text)).session); }
    std::string asc(const SessionRecord& record, const AscExportOptions& options = {}, int run = 1) {
        const fs::path folder = root.path() / fmt::format("asc_{}", ++files);
        export_asc(record, folder, options);
        return text_of(folder / fmt::format("sub-{}_ses-01_run-{:02}.asc",
                                            record.header().schedule.observer.label, run));
    }
};

const std::string layout = "PRESCALER\t1\nVPRESCALER\t1\nPUPIL\tAREA\n"
                           "EVENTS\tGAZE\tLEFT\tRATE\t1000.00\tTRACKING\tCR\tFILTER\t2\n"
                           "SAMPLES\tGAZE\tLEFT\tRATE\t1000.00\tTRACKING\tCR\tFILTER\t2\n";
const std::string file_header = "** DATE: Wed Aug 20 06:48:58 2014\n** VERSION: EYELINK II 1\n"
                                "** EYELINK II CL v5.03 Jul  3 2014\n\n";

std::string samples(int from, int to, const std::string& ending = "\t...\n") {
    std::string text;
    for (int ms = from; ms < to; ++ms)
        text += fmt::format("{}\t  500.5\t  400.5\t 1000.0{}", ms, ending);
    return text;
}

/// One recording over two trials; each ends with its result, and goes on for 30 ms. A fixation spans the
/// second TRIALID.
std::string continuous() {
    return file_header +
           "MSG\t999 RECCFG CR 1000 2 1 L\nMSG\t999 ELCLCFG MTABLER\n"
           "MSG\t999 GAZE_COORDS 0.00 0.00 1023.00 767.00\nSTART\t1000 \tLEFT\tSAMPLES\tEVENTS\n" +
           layout + samples(1000, 1010) + "MSG\t1010 TRIALID 1 easy left\n" + samples(1010, 1050) +
           "MSG\t1050 TRIAL_RESULT 0\n" + samples(1050, 1080) + "MSG\t1080 TRIALID 2 hard right\n" +
           samples(1080, 1100) + "EFIX L   1040\t1099\t60\t  500.5\t  400.5\t   1000\n" +
           samples(1100, 1120) + "MSG\t1120 TRIAL_RESULT 0\n" + samples(1120, 1150) +
           "END\t1150 \tSAMPLES\tEVENTS\tRES\t  35.00\t  35.00\n";
}

std::vector<std::int64_t> ms_of(const std::vector<GazeSample>& list) {
    std::vector<std::int64_t> ms;
    for (const GazeSample& sample : list)
        ms.push_back(asc_milliseconds(sample.sampled_at));
    return ms;
}

} // namespace

TEST_CASE(
    "a trial lasts from its TRIALID to its TRIAL_RESULT, whatever spans them, and what lies between trials "
    "is kept outside of them",
    "[unit]") {
    Lab lab;
    const SessionRecord record = lab.record(continuous());
    REQUIRE(record.trials().size() == 2);
    const TrialRecord &first = record.trials()[0], &second = record.trials()[1];
    // Session time runs from the file's first line, at 999 ms.
    CHECK(to_seconds(first.started.time_since_epoch()) == Approx(0.011));
    CHECK(to_seconds(second.started.time_since_epoch()) == Approx(0.081));
    CHECK(record.samples(first).size() == 50);
    CHECK(ms_of(record.samples(first)).back() == 1049);
    CHECK(ms_of(record.samples(second)).front() == 1080);
    CHECK(record.samples(second).size() == 40);
    std::vector<GazeSample> between;
    record.read_samples_after(first, 16, [&](std::span<const GazeSample> piece) {
        between.insert(between.end(), piece.begin(), piece.end());
    });
    CHECK(between.size() == 30);
    CHECK(verify_session(record.directory()).is_sound());

    // The tables have all of them; those between trials are of none.
    export_tables(
        record, [](const ViewedObject&) { return nullptr; }, lab.root.path() / "tables");
    const TsvFile rows(lab.root.path() / "tables" / "samples.tsv");
    CHECK(rows.size() == 150);
    int outside = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        outside += rows.text(i, "trial") == "n/a";
    CHECK(outside == 60);
}

TEST_CASE("what a recording does not tell of a trial is missing: no presentation, no answer", "[unit]") {
    Lab lab;
    const SessionRecord record = lab.record(continuous());
    export_tables(
        record, [](const ViewedObject&) { return nullptr; }, lab.root.path() / "tables");
    const TsvFile trials(lab.root.path() / "tables" / "trials.tsv"),
        responses(lab.root.path() / "tables" / "responses.tsv");
    for (std::size_t i = 0; i < 2; ++i) {
        for (const char* column : {"task_screen_onset_s", "presentation_onset_s", "presentation_end_s",
                                   "response_screen_onset_s", "responded_s"})
            CHECK(trials.text(i, column) == "n/a");
        CHECK(responses.text(i, "response_time_s") == "n/a");
        CHECK(responses.text(i, "responded_s") == "n/a");
    }
    CHECK(trials.text(0, "trialid_1") == "1");
    CHECK(trials.text(0, "trialid_2") == "easy");
    CHECK(trials.text(1, "trialid_3") == "right");

    export_bids(
        record, [](const ViewedObject&) { return nullptr; }, lab.root.path() / "bids");
    const TsvFile events(lab.root.path() /
                         "bids/sub-07/ses-01/beh/sub-07_ses-01_task-imported_run-01_events.tsv");
    REQUIRE(events.size() == 2); // no screens
    CHECK(std::stod(events.text(0, "duration")) == Approx(0.040));
    CHECK(std::stod(events.text(1, "duration")) == Approx(0.040));
    CHECK(events.text(0, "tracker_onset") == "1010000");
    CHECK(std::stod(events.text(0, "onset")) < std::stod(events.text(1, "onset")));
}

TEST_CASE("a recording that goes on over its trials stays one, and its export the same bytes", "[unit]") {
    Lab lab;
    const SessionRecord record = lab.record(continuous());
    const std::string text = lab.asc(record);
    for (const AscReading& reading : {read_as_eyelinker(text), read_as_mne(text)}) {
        CHECK(reading.failure == "");
        CHECK(reading.blocks == 1);
        CHECK(reading.samples.size() == 150);
        CHECK(std::count_if(reading.messages.begin(), reading.messages.end(),
                            [](const std::string& message) { return message.starts_with("TRIALID"); }) == 2);
    }
    CHECK(lab.asc(lab.record(text)) == text);
}

TEST_CASE("set-up lines that come twice are exported as they were, again and again", "[unit]") {
    Lab lab;
    std::string text = file_header;
    for (int trial = 0; trial < 2; ++trial) {
        const int start = 2000 + 1000 * trial;
        text += fmt::format("MSG\t{} TRIALID {}\n", start - 9, trial + 1);
        for (int twice = 0; twice < 2; ++twice)
            text += fmt::format("MSG\t{0} RECCFG CR 1000 2 1 L\nMSG\t{0} ELCLCFG MTABLER\n"
                                "MSG\t{0} GAZE_COORDS 0.00 0.00 1023.00 767.00\n",
                                start - 8 + 4 * twice);
        text += fmt::format("START\t{} \tLEFT\tSAMPLES\tEVENTS\n", start) + layout +
                samples(start, start + 20) +
                fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  35.00\t  35.00\nMSG\t{} TRIAL_RESULT 0\n",
                            start + 20, start + 21);
    }
    const std::string once = lab.asc(lab.record(text));
    CHECK(lab.asc(lab.record(once)) == once);
    const auto count = [&](const std::string& word) {
        int found = 0;
        for (std::size_t at = once.find(word); at != std::string::npos; at = once.find(word, at + 1))
            ++found;
        return found;
    };
    CHECK(count("RECCFG") == 4);
    CHECK(count("ELCLCFG") == 4);
    CHECK(count("GAZE_COORDS") == 4);
}

TEST_CASE("no sample of an export stands after END, and a layout without TRACKING gets none", "[unit]") {
    Lab lab;
    const std::string bare = "EVENTS\tGAZE\tLEFT\tRATE\t1000.00\tFILTER\t2\n"
                             "SAMPLES\tGAZE\tLEFT\tRATE\t1000.00\tFILTER\t2\n";
    const std::string text = lab.asc(
        lab.record(file_header + "MSG\t999 TRIALID 1\nSTART\t1000 \tLEFT\tSAMPLES\tEVENTS\n" + bare +
                   samples(1000, 1020, "\n") + "END\t1020 \tSAMPLES\tEVENTS\tRES\t  35.00\t  35.00\n" +
                   samples(1030, 1050, "\n") + "MSG\t1060 TRIAL_RESULT 0\n"));
    CHECK_THAT(text, !Contains("TRACKING") && Contains("RATE\t1000.00\tFILTER\t2\n"));
    const AscReading eyelinker = read_as_eyelinker(text);
    CHECK(eyelinker.failure == "");
    CHECK(eyelinker.samples.size() == 40);
    CHECK(eyelinker.blocks == 2);
}

TEST_CASE("samples of both eyes are known by their status where no line says so", "[unit]") {
    Lab lab;
    std::string text;
    for (int ms = 1000; ms < 1040; ++ms)
        text += fmt::format("{}\t  100.5\t  200.5\t 900.0\t  110.5\t  205.5\t 950.0\t.....\n", ms);
    const SessionRecord record = lab.record(text);
    CHECK(record.eyes(1).both());
    const std::vector<GazeSample> all = record.samples(record.trials()[0]);
    REQUIRE(all.size() == 80);
    CHECK(all[1].eye == Eye::right);
    CHECK(all[1].gaze->x_px == 110.5);
    CHECK(read_as_mne(lab.asc(record)).samples.size() == 40);
}

TEST_CASE("a recording's samples and events in two files are as in one, and its events alone can be exported",
          "[unit]") {
    Lab lab;
    AscExample example;
    example.trials = 3;
    std::string whole = asc_text(example);
    // Its fixations lie where its samples are.
    for (int trial = 0; trial < example.trials; ++trial)
        whole.replace(whole.find("\t  512.8\t  394.5\t"), 17,
                      fmt::format("\t  {:.1f}\t  {:.1f}\t", example_x(trial, 17, true), example_y(17)));
    std::string only_samples, only_events;
    for (const std::string& line : lines_of(whole))
        (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])) ? only_samples : only_events) +=
            line + "\n";
    const fs::path a = lab.file(only_samples), b = lab.file(only_events);
    const std::string expected = lab.asc(lab.record(whole));
    CHECK(lab.asc(SessionRecord(lab.import(AscFiles(a, b)).session)) == expected);
    CHECK(lab.asc(SessionRecord(lab.import(AscFiles(b, a)).session)) == expected);
    CHECK_THROWS_WITH(AscFiles(a, a), Contains("both have samples"));
    CHECK_THROWS_WITH(AscFiles(b, b), Contains("neither has samples"));

    const std::string events = lab.asc(lab.record(only_events));
    CHECK_THAT(events, Contains("EFIX L") && Contains("ESACC L") && Contains("START\t") && Contains("END\t"));
    CHECK(lab.asc(lab.record(events)) == events);
}

TEST_CASE("a duration that overflowed is taken from begin and end, and no event is left out for it",
          "[unit]") {
    for (const char* const duration : {"-2147483648", "4294967000", "99999999999999"}) {
        Lab lab;
        std::string text = asc_text({});
        // 500 Hz: from the first to the end of the last of five samples.
        const std::string numbers = "\t10\t  512.8\t  394.5\t   1063";
        for (std::size_t at = text.find(numbers); at != std::string::npos; at = text.find(numbers))
            text.replace(at, 3, std::string("\t") + duration);
        const AscImportSummary summary = lab.import(lab.file(text));
        const SessionRecord record(summary.session);
        int fixations = 0;
        for (const TrialRecord& trial : record.trials())
            record.read_gaze_events(trial, [&](const GazeEvent& event) {
                if (event.kind != GazeEvent::Kind::fixation)
                    return;
                ++fixations;
                CHECK(event.duration == std::chrono::milliseconds(10));
            });
        CHECK(fixations == 2);
        CHECK(summary.survey.skipped_lines == 0);
        std::string said;
        for (const std::string& remark : summary.remarks)
            said += remark;
        CHECK_THAT(said, Contains("2 fixations, saccades or blinks had a duration that cannot be") &&
                             !Contains("never ended"));
    }
}

TEST_CASE("half milliseconds of events are kept with fractional times", "[unit]") {
    Lab lab;
    std::string text = continuous();
    text.replace(text.find("1040\t1099\t60"), 12, "1040.5\t1099.0\t59.5");
    AscExportOptions options;
    options.fractional_times = true;
    CHECK_THAT(lab.asc(lab.record(text), options), Contains("EFIX L   1040.5\t1099\t59.5\t"));
}

TEST_CASE("a session's own export has what each reader looks for: the answer, the validation, its own date",
          "[unit]") {
    Lab lab;
    const fs::path session = make_eye_session(lab.root.path());
    const SessionRecord record(session);
    const std::string text = lab.asc(record);
    CHECK_THAT(text, Contains("!CAL VALIDATION HV0 L LEFT  ERROR 0.31 avg. 0.75 max\n"));
    CHECK_THAT(text, Contains("** DATE: Fri Mar  1 00:00:00 2024"));
    const auto count_of = [](const AscReading& reading, const std::string& word) {
        return std::count_if(reading.messages.begin(), reading.messages.end(),
                             [&](const std::string& message) { return words_of(message).at(0) == word; });
    };
    // Two of the three attempts were answered.
    for (const AscReading& reading : {read_as_eyelinker(text), read_as_mne(text)}) {
        CHECK(reading.failure == "");
        CHECK(count_of(reading, "RESPONSE") == 2);
        CHECK(count_of(reading, "ANSWER") == 2);
    }
    // PyGazeAnalyser ends a trial at any line in which it finds the stop word.
    bool is_in = false;
    std::size_t samples_in = 0, answers_in = 0;
    for (const std::string& line : lines_of(text)) {
        is_in = is_in ? line.find("END") == std::string::npos : line.find("START") != std::string::npos;
        samples_in += is_in && !line.empty() && std::isdigit(static_cast<unsigned char>(line[0]));
        answers_in += is_in && line.ends_with(" RESPONSE");
    }
    CHECK(samples_in == read_as_pymovements(text).samples.size());
    CHECK(answers_in == 2);

    CHECK_THAT(text, !Contains("start_trial"));
    AscExportOptions options;
    options.opensesame_messages = true;
    const std::string framed = lab.asc(record, options);
    CHECK_THAT(framed, Contains(" start_trial 1\n") && Contains(" end_trial\n") &&
                           Contains(" start_phase presentation\n") && Contains(" end_phase presentation\n") &&
                           Contains(" var material gold\n"));
}
