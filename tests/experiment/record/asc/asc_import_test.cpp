#include "experiment/record/asc/asc_import.h"
#include "experiment/record/verify/verification.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/ports/trial_mark.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/tables/table_export.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

AscImportOptions options_for(const fs::path& out, std::vector<std::string>* reports = nullptr) {
    AscImportOptions options;
    options.place = {out.parent_path() / "sessions", "imported", "07"};
    options.out = out;
    options.now_utc = "2026-01-01T00:00:00Z";
    if (reports)
        options.reading.report = [reports](const std::string& line) { reports->push_back(line); };
    return options;
}

/// Imports the text and gives the session.
SessionRecord imported(const test::TemporaryFolder& root, const std::string& text,
                       AscImportSummary* summary = nullptr, std::vector<std::string>* reports = nullptr) {
    static int count = 0;
    const fs::path file = write_asc(root.path() / fmt::format("recording_{}.asc", ++count), text);
    const fs::path out = root.path() / fmt::format("session_{}", count);
    const AscImportSummary result = import_asc(file, options_for(out, reports));
    if (summary)
        *summary = result;
    return SessionRecord(out);
}

void check_samples(const SessionRecord& record, const AscExample& example) {
    REQUIRE(record.trials().size() == static_cast<std::size_t>(example.trials));
    const int eyes = example.left && example.right ? 2 : 1;
    for (int trial = 0; trial < example.trials; ++trial) {
        const std::vector<GazeSample> samples =
            record.samples(record.trials()[static_cast<std::size_t>(trial)]);
        REQUIRE(samples.size() == static_cast<std::size_t>(example.samples * eyes));
        for (int n = 0; n < example.samples; ++n)
            for (int eye = 0; eye < eyes; ++eye) {
                const GazeSample& sample = samples[static_cast<std::size_t>(n * eyes + eye)];
                const bool is_left = example.left && eye == 0;
                REQUIRE(sample.sampled_at.time_since_epoch().count() == example_us(example, trial, n));
                REQUIRE((sample.eye == Eye::left) == is_left);
                REQUIRE(sample.gaze.has_value() == !example_is_lost(n));
                if (!sample.gaze)
                    continue;
                REQUIRE(sample.gaze->x_px == Approx(example_x(trial, n, is_left)).margin(1e-9));
                REQUIRE(sample.gaze->y_px == Approx(example_y(n)).margin(1e-9));
                REQUIRE(sample.pupil_area == static_cast<float>(900 + n));
            }
    }
}

std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename());
    return names;
}

} // namespace

TEST_CASE("recordings of each rate, eye and layout give the samples that are in them", "[unit]") {
    const test::TemporaryFolder root;
    std::vector<AscExample> examples;
    for (const double rate_hz : {250.0, 500.0, 1000.0, 2000.0}) {
        AscExample example;
        example.rate_hz = rate_hz;
        examples.push_back(example);
        example.left = false, example.right = true;
        examples.push_back(example);
        example.left = true;
        examples.push_back(example);
        example.float_times = true;
        examples.push_back(example);
        example.float_times = false, example.line_end = "\r\n";
        examples.push_back(example);
        example.line_end = "\n", example.right = false, example.head_target = true;
        examples.push_back(example);
    }
    for (const AscExample& example : examples) {
        CAPTURE(example.rate_hz, example.left, example.right, example.float_times, example.head_target);
        AscImportSummary summary;
        const SessionRecord record = imported(root, asc_text(example), &summary);
        check_samples(record, example);
        CHECK(summary.survey.skipped_lines == 0);
        CHECK(record.header().tracker.sample_rate_hz == example.rate_hz);
        CHECK(record.header().started_utc == "2024-02-29T23:59:59Z");
        CHECK(record.closed_in_order());
        CHECK(record.damages().empty());
        CHECK(verify_session(record.directory()).is_sound());
    }
}

TEST_CASE("recordings that lack parts give what is there, and say what was assumed", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    example.left = false, example.right = true;
    const auto without = [&](bool AscExample::*part) {
        AscExample changed = example;
        changed.*part = false;
        return changed;
    };
    for (bool AscExample::*part :
         {&AscExample::has_header, &AscExample::has_layout, &AscExample::has_blocks, &AscExample::has_status,
          &AscExample::has_events, &AscExample::has_trial_ids})
        check_samples(imported(root, asc_text(without(part))), example);

    AscExample bare = example;
    bare.has_header = bare.has_layout = bare.has_blocks = bare.has_status = bare.has_events = false;
    AscImportSummary summary;
    const SessionRecord record = imported(root, asc_text(bare), &summary);
    check_samples(record, example);
    CHECK(record.header().tracker.sample_rate_hz == Approx(500.0));
    std::string remarks;
    for (const std::string& remark : summary.remarks)
        remarks += remark + "\n";
    CHECK_THAT(remarks, Contains("DISPLAY_COORDS"));
    CHECK_THAT(remarks, Contains("--screen-mm"));
    CHECK_THAT(remarks, Contains("right one"));
    CHECK_THAT(remarks, Contains("500 Hz"));
}

TEST_CASE("a recording of events alone becomes a session without samples", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    example.has_samples = false;
    const SessionRecord record = imported(root, asc_text(example));
    REQUIRE(record.trials().size() == 2);
    CHECK(record.samples(record.trials()[0]).empty());
    int fixations = 0;
    record.read_gaze_events(record.trials()[1], [&](const GazeEvent& event) {
        fixations += event.kind == GazeEvent::Kind::fixation;
    });
    CHECK(fixations == 1);
}

TEST_CASE("the tracker's own events, messages and inputs are kept with their numbers", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    const SessionRecord record = imported(root, asc_text(example));
    std::map<GazeEvent::Kind, std::vector<GazeEvent>> events;
    record.read_gaze_events(record.trials()[0],
                            [&](const GazeEvent& event) { events[event.kind].push_back(event); });
    using Kind = GazeEvent::Kind;
    REQUIRE(events[Kind::fixation].size() == 1);
    const GazeEvent fixation = events[Kind::fixation][0];
    CHECK(fixation.eye == Eye::left);
    CHECK(fixation.start == TrackerTime(std::chrono::milliseconds(5030)));
    CHECK(fixation.end == TrackerTime(std::chrono::milliseconds(5038)));
    CHECK(fixation.duration == std::chrono::milliseconds(10));
    CHECK(fixation.place == ScreenPoint{512.8, 394.5});
    CHECK(fixation.pupil == 1063.0);
    REQUIRE(events[Kind::saccade].size() == 1);
    CHECK(events[Kind::saccade][0].place == ScreenPoint{512.8, -39.5});
    CHECK(events[Kind::saccade][0].arrival == ScreenPoint{509.2, 380.4});
    CHECK(events[Kind::saccade][0].amplitude_deg == 0.46);
    CHECK(events[Kind::saccade][0].peak_velocity_deg_s == 57.0);
    REQUIRE(events[Kind::blink].size() == 1);
    CHECK(events[Kind::input][0].text == "127");
    CHECK(events[Kind::button][0].text == "5 1");
    CHECK(events[Kind::ended][0].text == "35.24 35.17");
    CHECK(events[Kind::message].front().text == "TRIALID 1");
    // Before the first trial: the screen, and the calibration with its lines that have no time.
    std::vector<std::string> outside;
    record.read_gaze_events_outside([&](const GazeEvent& event) { outside.push_back(event.text); });
    REQUIRE(outside.size() == 5);
    CHECK(outside[1] == ">>>>>>> CALIBRATION (HV3,P-CR) FOR LEFT: <<<<<<<<<");
    CHECK(outside[3] == "\t  -80     7   -84     8");
    const std::optional<GazeSource> source = record.gaze_source(1);
    REQUIRE(source);
    CHECK(source->px_per_deg_x == 35.24);
    CHECK(source->sha256.size() == 64);
}

TEST_CASE("each malformed line is reported with its place, counted, and left out; all others are kept",
          "[unit]") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"5000000\t12.0", "without all its values"},
        {"5000000\tabc\t12.0\t900.0\t...", "no number"},
        {"5000000\t-nan\t12.0\t900.0\t...", "no number"},
        {"5000000\tinf\t12.0\t900.0\t...", "no number"},
        {"99999999999999999999\t1.0\t2.0\t3.0", "no time stamp"},
        {"12-5\t1.0\t2.0\t3.0\t...", "no time stamp"},
        {"1\t1.0\t2.0\t3.0\t...", "earlier"},
        {"MSG\tsoon TRIALID 9", "without a time"},
        {"MSG", "without a time"},
        {"EFIX X   1\t2\t3", "without eye"},
        {"EFIX L   5000\t4000\t3\t1\t2\t3", "without eye, begin, end"},
        {"ESACC L  1\t2\t3\t1.0", "without all its values"},
        {"EBLINK L", "without eye"},
        {"SFIX L", "without eye or time"},
        {"END\tnever", "without a time"},
        {"BUTTON\t?", "without a time"},
        {"\t  -80     7", "begins with a blank"},
        {"GARBAGE", "no known word"},
        {std::string("\0\0\xff\xfe", 4), "no known word"},
        {std::string(20'000, 'x'), "longer than"}};
    const test::TemporaryFolder root;
    AscExample example;
    const std::string sound = asc_text(example);
    for (const auto& [line, why] : cases) {
        CAPTURE(line.substr(0, 40));
        // In the middle of the second trial.
        std::size_t at = sound.find("\n7060\t") + 1;
        REQUIRE(at > 1);
        const auto line_number =
            1 + std::count(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        std::string text = sound;
        text.insert(at, line + "\n");
        AscImportSummary summary;
        std::vector<std::string> reports;
        const SessionRecord record = imported(root, text, &summary, &reports);
        check_samples(record, example);
        CHECK(summary.survey.skipped_lines == 1);
        REQUIRE(reports.size() == 1);
        CHECK_THAT(reports[0], Contains(fmt::format(".asc:{}: ", line_number)) && Contains(why));
        CHECK(record.gaze_source(1)->skipped_lines == 1);
        // It stays known: the record has it, too.
        const std::vector<RecordedEvent> events = record.events();
        REQUIRE(events.size() == 1);
        CHECK(events[0].kind == "line left out");
        CHECK(events[0].detail == reports[0].substr(reports[0].find(".asc:") + 5));
    }
}

TEST_CASE("what edf2asc was told to write for missing data is missing, as its points are", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    for (const char* word : {"NaN", "nan", "-32768", "100000000"}) {
        CAPTURE(word);
        std::string text = asc_text(example);
        const std::string point = "\t   .\t   .\t";
        for (std::size_t at = text.find(point); at != std::string::npos; at = text.find(point, at + 1))
            text.replace(at, point.size(), fmt::format("\t{0}\t{0}\t", word));
        AscImportSummary summary;
        check_samples(imported(root, text, &summary), example);
        CHECK(summary.survey.skipped_lines == 0);
    }
}

TEST_CASE("what an import does not keep of a recording is said", "[unit]") {
    const test::TemporaryFolder root;
    const auto remarks_of = [&](const std::string& text) {
        AscImportSummary summary;
        imported(root, text, &summary);
        std::string remarks;
        for (const std::string& remark : summary.remarks)
            remarks += remark + "\n";
        return remarks;
    };
    const auto with = [](std::string text, const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        return text;
    };
    const std::string sound = asc_text({});
    CHECK_THAT(remarks_of(sound), !Contains("not kept") && !Contains("rate changes"));
    CHECK_THAT(remarks_of(with(sound, "\t...\n", "\t   12.5\t  -3.0\t...\n")),
               Contains("further numbers (velocity, resolution or input)"));
    AscExample bare;
    bare.left = false, bare.right = true, bare.has_layout = bare.has_blocks = bare.has_events = false;
    CHECK_THAT(remarks_of(with(asc_text(bare), "\t...\n", "\t   12.5\t  -3.0\t 900.0\t...\n")),
               Contains("perhaps of the other eye"));
    CHECK_THAT(remarks_of(with(sound, "\t 500.00", "\t1000.00").replace(sound.find(" 500 2 1"), 4, " 250")),
               Contains("from 250 to 1000 Hz"));

    const std::string in_the_head = with(sound, "EVENTS\tGAZE", "EVENTS\tHREF");
    CHECK_THAT(remarks_of(in_the_head), Contains("4 fixations and saccades are not in gaze coordinates"));
    const SessionRecord record = imported(root, in_the_head);
    int seen = 0;
    record.read_gaze_events(record.trials()[0], [&](const GazeEvent& event) {
        CHECK_FALSE(event.place.has_value());
        seen += event.kind == GazeEvent::Kind::fixation || event.kind == GazeEvent::Kind::saccade;
    });
    CHECK(seen == 2);
}

TEST_CASE("SYNCTIME says when the stimulus came, by as many milliseconds earlier as stand before it",
          "[unit]") {
    const test::TemporaryFolder root;
    for (const auto& [words, late_ms] : std::vector<std::pair<std::string, int>>{
             {"SYNCTIME", 0}, {"7 SYNCTIME", 7}, {"-11 SYNCTIME", -11}, {"5 SYNCTIME 3", 5}}) {
        CAPTURE(words);
        std::string text = asc_text({});
        text.replace(text.find("PRESENTATION_ONSET"), 18, words);
        const SessionRecord record = imported(root, text);
        CHECK(record.trials()[0].outcome.presentation_onset ==
              record.clock_map(1)->to_session(TrackerTime(std::chrono::milliseconds(5020 - late_ms))).time);
    }
}

TEST_CASE("messages that overt sends to a tracker say when the stimulus was taken away, however late they "
          "were sent",
          "[unit]") {
    const test::TemporaryFolder root;
    const auto end_by = [&](const std::string& words) {
        std::string text = asc_text({});
        text.insert(text.find("EFIX"), "MSG\t5038 " + words + "\n");
        return imported(root, text).trials()[0].outcome.presentation_end;
    };
    const SessionTime end = end_by(std::string(presentation_end_mark));
    CHECK(end_by("3 " + std::string(presentation_end_mark)) == end - std::chrono::milliseconds(3));
    CHECK(end_by("-2 PRESENTATION_END") == end + std::chrono::milliseconds(2)); // of earlier recordings
}

TEST_CASE("a malformed line between the two samples of a millisecond leaves both in their places", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    example.rate_hz = 2000.0;
    const std::string sound = asc_text(example);
    const std::size_t first = sound.find("\n7005\t") + 1, second = sound.find("\n7005\t", first) + 1;
    for (const char* line : {"1\t1.0\t2.0\t3.0\t...\n", "7\n", "900000000\tabc\t2.0\t3.0\t...\n", "noise\n",
                             "99999999999999999999\t1.0\t2.0\t3.0\n"}) {
        CAPTURE(line);
        std::string text = sound;
        text.insert(second, line);
        AscImportSummary summary;
        check_samples(imported(root, text, &summary), example);
        CHECK(summary.survey.skipped_lines == 1);
    }
    // Where the first of the two is broken itself, the second keeps its half millisecond.
    std::string broken = sound;
    broken.replace(broken.find('\t', first) + 1, 3, "abc");
    std::vector<std::string> reports;
    const SessionRecord record = imported(root, broken, nullptr, &reports);
    REQUIRE(reports.size() == 1);
    const std::vector<GazeSample> samples = record.samples(record.trials()[1]);
    REQUIRE(samples.size() == 59);
    CHECK(samples[10].sampled_at == TrackerTime(std::chrono::microseconds(7'005'500)));
}

TEST_CASE("texts that are no UTF-8 are taken for Latin-1 and said to be so", "[unit]") {
    const test::TemporaryFolder root;
    AscImportSummary summary;
    const SessionRecord record =
        imported(root, asc_text({}) + "MSG\t9000000 caf\xe9\nMSG\t9000001 caf\xc3\xa9\n", &summary);
    std::vector<std::string> texts;
    record.read_gaze_events_after(record.trials()[1],
                                  [&](const GazeEvent& event) { texts.push_back(event.text); });
    REQUIRE(texts.size() == 2);
    CHECK(texts[texts.size() - 2] == "café");
    CHECK(texts[texts.size() - 1] == "café");
    CHECK(summary.survey.non_ascii_texts == 1);
}

TEST_CASE("an import overwrites nothing and leaves nothing behind when it fails", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path file = write_asc(root.path() / "a.asc", asc_text({}));
    import_asc(file, options_for(root.path() / "s"));
    CHECK_THROWS_WITH(import_asc(file, options_for(root.path() / "s")), Contains("exists already"));
    AscImportOptions by_place = options_for({});
    by_place.out.clear();
    by_place.place.root = root.path() / "sessions";
    CHECK(import_asc(file, by_place).session.filename() == "sub-07_ses-01");
    CHECK(import_asc(file, by_place).session.filename() == "sub-07_ses-02");
    by_place.session_number = 1;
    CHECK_THROWS_WITH(import_asc(file, by_place), Contains("next free"));

    const auto before = entries(root.path());
    CHECK_THROWS_AS(import_asc(root.path() / "none.asc", options_for(root.path() / "t")), InputError);
    CHECK_THROWS_AS(import_asc(root.path(), options_for(root.path() / "t")), InputError);
    CHECK_THROWS_WITH(
        import_asc(write_asc(root.path() / "a.asc", "no recording\n"), options_for(root.path() / "t")),
        Contains("no recording of an EyeLink"));
    // Another tracker's table, whose first numbers would pass for time, place and pupil.
    std::string table = "time\tx\ty\tpupil\tvalidity\n";
    for (int n = 0; n < 100; ++n)
        table += fmt::format("{}\t{}.5\t{}.25\t3.64\t0\n", 1000 + 3 * n, 400 + n, 300 - n);
    CHECK_THROWS_WITH(import_asc(write_asc(root.path() / "a.asc", table), options_for(root.path() / "t")),
                      Contains("table of numbers"));
    CHECK_THROWS_WITH(import_asc(write_asc(root.path() / "a.asc", asc_text({}) + asc_text({})),
                                 options_for(root.path() / "t")),
                      Contains("began anew"));
    CHECK(entries(root.path()) == before);
}

TEST_CASE("an imported session can be exported as tables", "[unit]") {
    const test::TemporaryFolder root;
    AscExample example;
    example.right = true;
    const auto counts = export_tables(
        imported(root, asc_text(example)), [](const ViewedObject&) { return nullptr; },
        root.path() / "tables");
    CHECK(counts.samples == 240);
    CHECK(counts.samples_without_gaze == 40);
    // The tracker's own events have a table.
    std::ifstream stream(root.path() / "tables" / "gaze_events.tsv");
    const std::string table{std::istreambuf_iterator<char>(stream), {}};
    CHECK_THAT(
        table,
        Contains(
            "\n07\t1\t1\tfixation\ttracker\tleft\t1.030000000\t1.038000000\t0.010000000\t5030000\t5038000\t"
            "512.800\t394.500\tn/a\tn/a\t1063.0000\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tno stimulus "
            "known\tn/a\n"));
    CHECK_THAT(table, Contains("\n07\t1\t2\tsaccade\ttracker\tleft\t") &&
                          Contains("\t512.800\t-39.500\t509.200\t380.400\tn/a\t0.460\t57.000\tn/a\tn/a\tn/"
                                   "a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\n"));
    CHECK_THAT(
        table,
        Contains("\n07\t1\tn/a\tmessage\tn/a\tn/a\t0.000000000\t0.000000000\tn/a\t4000000\t4000000\t") &&
            Contains("\tDISPLAY_COORDS 0 0 1023 767\n") && Contains("\tbutton\t"));
    CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 5 + 2 * 12);
}

TEST_CASE("a pupil in an export has the digits that it has in the recording", "[unit]") {
    const test::TemporaryFolder root;
    std::string text = asc_text({});
    text.replace(text.find("  900.0"), 7, " 2338.6");
    const SessionRecord record = imported(root, text);
    export_tables(
        record, [](const ViewedObject&) { return nullptr; }, root.path() / "tables");
    export_asc(record, root.path() / "asc");
    const auto holds = [&](const fs::path& file, const std::string& words) {
        std::ifstream stream(root.path() / file);
        CHECK_THAT((std::string{std::istreambuf_iterator<char>(stream), {}}), Contains(words));
    };
    holds("tables/samples.tsv", "\t100.000\t700.000\t2338.6000\t");
    holds("asc/sub-07_ses-01_run-01.asc", "\t  100.0\t  700.0\t 2338.6\t...\n");
}
