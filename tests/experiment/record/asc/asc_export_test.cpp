#include "experiment/record/asc/asc_export.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/number_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/asc/asc_import.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_readers.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

struct Exported {
    test::TemporaryFolder root;
    fs::path session = make_eye_session(root.path());
    fs::path target = root.path() / "asc";
    AscExportCounts counts = export_asc(SessionRecord(session), target);

    std::string run(int number) const {
        return text_of(target / fmt::format("sub-AB7_ses-01_run-{:02}.asc", number));
    }
};

std::string decimals(double number, int places) {
    std::string text;
    append_fixed(text, number, places);
    return text;
}

/// What an ASC can hold of a sample: whole milliseconds, thousandths of a pixel, no pupil without gaze.
std::vector<std::string> written_form(const SessionRecord& record, int sitting) {
    std::vector<std::string> samples;
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != sitting)
            continue;
        std::int64_t last_ms = -1;
        for (const GazeSample& sample : record.samples(trial)) {
            const std::int64_t ms = sample.sampled_at.time_since_epoch().count() / 1000;
            samples.push_back(fmt::format(
                "{}{} {} {}", ms, ms == last_ms ? ".5" : "", sample.eye == Eye::left ? "L" : "R",
                sample.gaze ? decimals(sample.gaze->x_px, 3) + " " + decimals(sample.gaze->y_px, 3) + " " +
                                  decimals(static_cast<double>(sample.pupil_area), 4)
                            : std::string("lost")));
            last_ms = ms;
        }
    }
    return samples;
}

AscImportOptions into(const fs::path& out, const std::string& label = "AB7") {
    AscImportOptions options;
    options.place = {out.parent_path(), "imported", label};
    options.out = out;
    return options;
}

} // namespace

TEST_CASE("eyelinker, MNE, pymovements and PyGazeAnalyser find every sample of an exported session",
          "[unit]") {
    const Exported exported;
    CHECK(exported.counts.files == 2);
    const SessionRecord record(exported.session);
    std::int64_t samples = 0;
    for (const int sitting : {1, 2}) {
        std::vector<GazeSample> recorded;
        for (const TrialRecord& trial : record.trials())
            if (trial.sitting == sitting)
                for (const GazeSample& sample : record.samples(trial))
                    recorded.push_back(sample);
        samples += static_cast<std::int64_t>(recorded.size());
        const std::string text = exported.run(sitting);
        const AscReading readings[] = {read_as_eyelinker(text), read_as_mne(text), read_as_pymovements(text),
                                       read_as_pygaze_analyser(text, "TRIALID")};
        for (const AscReading& reading : readings) {
            CHECK(reading.failure == "");
            REQUIRE(reading.samples.size() == recorded.size());
            for (std::size_t i = 0; i < recorded.size(); ++i) {
                REQUIRE(
                    reading.samples[i].time ==
                    static_cast<double>(std::chrono::floor<std::chrono::milliseconds>(recorded[i].sampled_at)
                                            .time_since_epoch()
                                            .count()));
                REQUIRE(reading.samples[i].x.has_value() == recorded[i].gaze.has_value());
                if (recorded[i].gaze) {
                    REQUIRE(*reading.samples[i].x == Approx(recorded[i].gaze->x_px).margin(5.1e-4));
                    REQUIRE(*reading.samples[i].y == Approx(recorded[i].gaze->y_px).margin(5.1e-4));
                    REQUIRE(reading.samples[i].pupil == Approx(recorded[i].pupil_area).margin(5.1e-5));
                }
            }
        }
        // Both drop what stands outside of recordings; MNE also what has "!V", "!MODE" or a semicolon in it.
        for (const AscReading& reading : {readings[0], readings[1]}) {
            const auto count_of = [&](const std::string& word) {
                return std::count_if(reading.messages.begin(), reading.messages.end(),
                                     [&](const std::string& message) { return message.starts_with(word); });
            };
            CHECK(count_of("PRESENTATION_ONSET") >= 1);
            CHECK(count_of("CONDITION trial=") == reading.blocks);
        }
    }
    CHECK(exported.counts.samples == samples);
    CHECK(exported.counts.trials == 5);
}

TEST_CASE(
    "the recordings of an exported session are as long as their samples, so that lost ones can be counted",
    "[unit]") {
    const Exported exported;
    // 400, 200 and 400 samples of which every 37th was dropped: the blocks' lengths count the dropped ones.
    CHECK(read_as_pymovements(exported.run(1)).expected_samples == Approx(1000.0).margin(6.0));
}

TEST_CASE("above 1000 Hz MNE keeps every sample of fractional times, and every other one of whole times",
          "[unit]") {
    const Exported exported;
    const AscReading whole = read_as_mne(exported.run(1));
    CHECK(whole.samples_after_merge < 0.6 * static_cast<double>(whole.samples.size()));

    AscExportOptions options;
    options.fractional_times = true;
    export_asc(SessionRecord(exported.session), exported.root.path() / "fractional", options);
    const std::string text = text_of(exported.root.path() / "fractional/sub-AB7_ses-01_run-01.asc");
    const AscReading mne = read_as_mne(text);
    CHECK(mne.samples_after_merge == static_cast<double>(mne.samples.size()));
    for (const AscReading& reading : {read_as_eyelinker(text), mne, read_as_pymovements(text)}) {
        CHECK(reading.failure == "");
        REQUIRE(reading.samples.size() == whole.samples.size());
        CHECK(reading.samples[1].time - reading.samples[0].time == Approx(0.5));
    }
    const AscImportSummary imported =
        import_asc(exported.root.path() / "fractional/sub-AB7_ses-01_run-01.asc",
                   into(exported.root.path() / "imported"));
    const SessionRecord record(exported.session), again(imported.session);
    CHECK(again.samples(again.trials()[0])[1].sampled_at == record.samples(record.trials()[0])[1].sampled_at);
}

TEST_CASE("readers take what is exported of recordings that lack what they need, or have it where they fail",
          "[unit]") {
    test::TemporaryFolder root;
    // Both eyes; one recording that goes on through all trials and is cut off; the right eye's first place
    // has the length of a status; GAZE_COORDS, but no RECCFG; a clock that does not fit into 31 bits.
    constexpr std::int64_t begin_ms = 800'000'000'000;
    std::string file = "** DATE: Wed Aug 20 06:48:58 2014\n** VERSION: EYELINK II 1\n"
                       "** EYELINK II CL v5.03 Jul  3 2014\n\n";
    const auto add = [&](std::string_view form, std::int64_t ms, std::string_view rest) {
        file += fmt::format(fmt::runtime(form), ms, rest);
    };
    add("MSG\t{} TRIALID 1\n", begin_ms, "");
    add("MSG\t{} GAZE_COORDS 0.00 0.00 1919.00 1079.00\n", begin_ms, "");
    add("START\t{} \tLEFT\tRIGHT\tSAMPLES\tEVENTS\n", begin_ms + 1, "");
    file += "PRESCALER\t1\nVPRESCALER\t1\nPUPIL\tAREA\n"
            "EVENTS\tGAZE\tLEFT\tRIGHT\tRATE\t1000.00\tTRACKING\tCR\tFILTER\t2\n"
            "SAMPLES\tGAZE\tLEFT\tRIGHT\tRATE\t1000.00\tTRACKING\tCR\tFILTER\t2\n";
    for (int n = 1; n <= 300; ++n) {
        if (n % 100 == 0 && n < 300)
            file += fmt::format("MSG\t{} TRIALID {}\n", begin_ms + n, n / 100 + 1);
        if (n == 150)
            add("MSG\t{} in the middle\n", begin_ms + n, "");
        add("{}\t  -10.1\t  -20.2\t 1000.0\t  -30.3\t  -40.4\t 1001.0\t.....\n", begin_ms + n, "");
    }
    std::ofstream(root.path() / "odd.asc") << file;
    const AscImportSummary imported = import_asc(root.path() / "odd.asc", into(root.path() / "session"));
    export_asc(SessionRecord(imported.session), root.path() / "asc");
    const std::string text = text_of(root.path() / "asc/sub-AB7_ses-01_run-01.asc");
    CHECK_THAT(text, Contains("** REMARK: 799900000000 ms were taken from the tracker's times"));
    const AscReading readings[] = {read_as_eyelinker(text), read_as_mne(text), read_as_pymovements(text),
                                   read_as_pygaze_analyser(text, "TRIALID")};
    for (const AscReading& reading : readings) {
        CHECK(reading.failure == "");
        REQUIRE(reading.samples.size() == 300);
        CHECK(reading.samples[0].x == Approx(-10.1));
        CHECK(reading.samples[299].time == 100'000'300.0);
    }
    // One recording, as in the file: MNE sees its trials only within START and END.
    for (const AscReading& reading : {readings[0], readings[1]}) {
        CHECK(reading.blocks == 1);
        CHECK(reading.messages == std::vector<std::string>{"TRIALID 2", "in the middle", "TRIALID 3"});
    }
    CHECK(readings[2].expected_samples == 300.0);
}

TEST_CASE("an exported session holds its trials, aborted ones too, and nothing but ASCII", "[unit]") {
    const Exported exported;
    const std::string text = exported.run(1);
    const auto occurrences = [&](const std::string& word) {
        int count = 0;
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
            ++count;
        return count;
    };
    CHECK(occurrences("TRIALID 1\n") == 1);
    CHECK(occurrences("TRIALID 2\n") == 2);
    CHECK(occurrences("TRIAL_RESULT 0\n") == 2);
    CHECK(occurrences("TRIAL_RESULT aborted\n") == 1);
    CHECK(occurrences("\nSTART\t") == 3);
    CHECK(occurrences("\nEND\t") == 3);
    CHECK(occurrences("DISPLAY_COORDS 0 0 1919 1079\n") == 1);
    CHECK_THAT(text, Contains("simuliert \\u2013 \\u00fc"));
    CHECK_THAT(text, Contains("CONDITION trial=1 task=age object=bust material=silver attempt=1"));
    CHECK_THAT(text, Contains("!V TRIAL_VAR frames rendered\n"));
    CHECK(std::all_of(text.begin(), text.end(),
                      [](char c) { return c == '\n' || c == '\t' || (c >= ' ' && c < 127); }));
    // The tracker's time of a screen is that of the session, by the clocks.
    CHECK_THAT(text, Contains(fmt::format("MSG\t{} PRESENTATION_ONSET\n", 7'000'000 + 11'000)));
}

namespace {

/// Times in milliseconds of the messages that begin with a word, in the file's order.
std::vector<long long> times_of(const std::string& text, const std::string& word) {
    std::vector<long long> times;
    for (std::size_t at = text.find("MSG\t"); at != std::string::npos; at = text.find("MSG\t", at + 1)) {
        const std::size_t blank = text.find(' ', at);
        if (text.compare(blank + 1, word.size(), word) == 0)
            times.push_back(std::stoll(text.substr(at + 4, blank - at - 4)));
    }
    return times;
}

} // namespace

TEST_CASE("a loss of data is a message, and each line of an export is one that the format has", "[unit]") {
    const test::TemporaryFolder root;
    const SessionHeader header = eye_session_header();
    const fs::path session = make_session(root.path(), header);
    {
        SessionStore store(session / session_file_name, patient());
        for (const std::int64_t second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second), TrackerTime(std::chrono::seconds(second)), at_ms(1000 * second)});
        const Trial& trial = header.schedule.trials[0];
        record_attempt(store, 0, trial, 1000, 200, std::nullopt);
        store.tracker_item(trial.index, TrackerGap{TrackerGap::Reason::connection,
                                                   TrackerTime(std::chrono::milliseconds(1950)), 12});
        store.trial_finished(trial, outcome_at(1000));
    }
    export_asc(SessionRecord(session), root.path() / "asc", {});
    const std::string text = read_whole_file(root.path() / "asc/sub-AB7_ses-01_run-01.asc");
    constexpr std::string_view begins[] = {"**",           "MSG\t",   "START\t",  "END\t",     "PRESCALER\t",
                                           "VPRESCALER\t", "PUPIL\t", "EVENTS\t", "SAMPLES\t", "SFIX",
                                           "EFIX",         "SSACC",   "ESACC",    "SBLINK",    "EBLINK",
                                           "BUTTON",       "INPUT",   ">>>>>>>"};
    bool is_told = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        INFO(line);
        is_told = is_told || (line.starts_with("MSG\t") && line.find("12") != std::string::npos &&
                              line.find(name_of(TrackerGap::Reason::connection)) != std::string::npos);
        CHECK((line.empty() || (line.front() >= '0' && line.front() <= '9') ||
               std::ranges::any_of(begins, [&](std::string_view begin) { return line.starts_with(begin); })));
    }
    CHECK(is_told);
}

TEST_CASE("attempts that follow at once stand one after the other by their times, too", "[unit]") {
    const test::TemporaryFolder root;
    SessionHeader header = eye_session_header();
    const fs::path session = make_session(root.path(), header);
    {
        SessionStore store(session / session_file_name, patient());
        for (const std::int64_t second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second), TrackerTime(std::chrono::seconds(second)), at_ms(1000 * second)});
        // The first is broken off, and comes again in the same millisecond.
        const Trial& trial = header.schedule.trials[0];
        record_attempt(store, 0, trial, 1000, 200, TrialOutcome::Status::aborted);
        record_attempt(store, 0, trial, 2000, 200, TrialOutcome::Status::aborted);
        record_attempt(store, 0, header.schedule.trials[1], 2999, 200, TrialOutcome::Status::completed);
    }
    const SessionRecord record(session);
    AscExportOptions options;
    options.opensesame_messages = true;
    export_asc(record, root.path() / "asc", options);
    const std::string text = read_whole_file(root.path() / "asc/sub-AB7_ses-01_run-01.asc");
    INFO(text.substr(0, 3000));
    for (const auto& [first, last] :
         {std::pair{"TRIALID ", "TRIAL_RESULT "}, {"start_trial ", "end_trial"}}) {
        const std::vector<long long> begins = times_of(text, first), ends = times_of(text, last);
        REQUIRE(begins.size() == 3);
        REQUIRE(ends.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(begins[i] < ends[i]);
            CHECK((i == 2 || ends[i] < begins[i + 1]));
        }
    }
    // Of each attempt how it ended, inside of it.
    CHECK_THAT(text, Contains("var attempt 2\n") && Contains("var counts no\n") &&
                         Contains("var counts yes\n") && Contains("var status aborted\n") &&
                         Contains("var status completed\n") && Contains("var response_time_ms ") &&
                         Contains("var answer vierzig"));
    for (const std::string name : {"attempt", "status", "counts"})
        CHECK(times_of(text, "var " + name + " ").size() == 3);
}

TEST_CASE("what was exported as ASC and imported has the same samples, and its export the same bytes",
          "[unit]") {
    const Exported exported;
    const SessionRecord record(exported.session);
    for (const int sitting : {1, 2}) {
        const fs::path file = exported.target / fmt::format("sub-AB7_ses-01_run-{:02}.asc", sitting);
        const fs::path out = exported.root.path() / fmt::format("imported_{}", sitting);
        const AscImportSummary summary = import_asc(file, into(out));
        CHECK(summary.survey.skipped_lines == 0);
        const SessionRecord imported(out);
        CHECK(written_form(imported, 1) == written_form(record, sitting));
        CHECK(imported.header().display.screen.screen_px == glm::ivec2(1920, 1080));
        CHECK(imported.header().display.screen.viewing_distance_mm == 571.0);
        CHECK(imported.header().display.screen.screen_mm.x == Approx(400.5));
        export_asc(imported, exported.root.path() / fmt::format("again_{}", sitting));
        CHECK(text_of(exported.root.path() / fmt::format("again_{}", sitting) /
                      "sub-AB7_ses-01_run-01.asc") == exported.run(sitting));
    }
    const SessionRecord first(exported.root.path() / "imported_1");
    CHECK(first.trials()[1].status == TrialRecord::Status::aborted);
    CHECK(first.trials()[0].outcome.presentation_onset - first.trials()[0].outcome.task_screen_onset ==
          std::chrono::milliseconds(990));
}

TEST_CASE("recordings of one eye, of both and at other rates in one file are exported each as it was",
          "[unit]") {
    const Exported exported;
    AscExample first, second;
    first.right = true, first.rate_hz = 2000.0, first.trials = 1;
    second.left = false, second.right = true, second.rate_hz = 250.0;
    for (const bool both_first : {true, false}) {
        AscExample last = both_first ? second : first;
        last.trials = 2;
        const std::string text = asc_text(last), begin = asc_text(both_first ? first : second);
        const std::string cut = "TRIALID 2"; // the first trial of one, the second of the other
        const auto line_of = [&](const std::string& all) {
            const std::size_t at = all.find(cut);
            return at == std::string::npos ? all.size() : all.rfind('\n', at) + 1;
        };
        const fs::path root = exported.root.path() / (both_first ? "a" : "b");
        fs::create_directories(root);
        import_asc(write_asc(root / "both.asc", begin.substr(0, line_of(begin)) + text.substr(line_of(text))),
                   into(root / "session"));
        const SessionRecord record(root / "session");
        export_asc(record, root / "asc");
        const std::string written = text_of(root / "asc" / "sub-AB7_ses-01_run-01.asc");
        CHECK_THAT(written, Contains("SAMPLES\tGAZE\tRIGHT\tRATE\t 250.00") &&
                                Contains("SAMPLES\tGAZE\tLEFT\tRIGHT\tRATE\t2000.00"));
        import_asc(root / "asc" / "sub-AB7_ses-01_run-01.asc", into(root / "imported"));
        CHECK(written_form(SessionRecord(root / "imported"), 1) == written_form(record, 1));
        CHECK(written_form(record, 1).size() == 2 * 60 + 60);
        export_asc(SessionRecord(root / "imported"), root / "again");
        CHECK(text_of(root / "again" / "sub-AB7_ses-01_run-01.asc") == written);
    }
}

TEST_CASE("an export as ASC replaces an earlier one only when asked, and a session without gaze has none",
          "[unit]") {
    const Exported exported;
    const SessionRecord record(exported.session);
    CHECK_THROWS_WITH(export_asc(record, exported.target), Contains("exists already"));
    CHECK_NOTHROW(export_asc(record, exported.target, {true, false, {}, {}}));
    std::ofstream(exported.target / "notes.txt") << "mine";
    CHECK_THROWS_WITH(export_asc(record, exported.target, {true, false, {}, {}}), Contains("notes.txt"));
    SessionHeader header = eye_session_header();
    header.schedule.observer.label = "C1";
    const fs::path empty = make_session(exported.root.path(), header);
    CHECK_THROWS_AS(export_asc(SessionRecord(empty), exported.root.path() / "none"), InputError);
    CHECK_FALSE(fs::exists(exported.root.path() / "none"));
}
