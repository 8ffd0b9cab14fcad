/// Recordings that other programs, other places and other options of edf2asc make, with their right values.
#include <catch2/catch.hpp>

#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/tables/table_export.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/asc_readers.h"
#include "tests/support/asc_text.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// Imports recordings into a folder of its own.
struct ImportBench {
    test::TemporaryFolder root;
    AscSurveyOptions reading;
    AscImportSummary summary;
    int sessions = 0;

    fs::path file(const std::string& name, const std::string& text) {
        return write_asc(root.path() / name, text);
    }
    SessionRecord import(const AscFiles& files) {
        AscImportOptions options;
        options.place = {root.path(), "imported", "07"};
        options.out = root.path() / fmt::format("session_{}", ++sessions);
        options.screen_mm = glm::dvec2(400.0, 300.0);
        options.viewing_distance_mm = 600.0;
        options.reading = reading;
        summary = import_asc(files, options);
        return SessionRecord(summary.session);
    }
    SessionRecord import(const std::string& text) { return import(AscFiles(file("text.asc", text))); }
    SessionRecord field_case(const std::string& name) {
        return import(AscFiles(fs::path(OVERT_SOURCE_DIR) / "tests/data/asc" / (name + ".asc")));
    }
    std::string remarks() const { return fmt::format("{}", fmt::join(summary.remarks, "\n")); }
};

std::vector<GazeSample> samples_of(const SessionRecord& record) {
    std::vector<GazeSample> all;
    for (const TrialRecord& trial : record.trials())
        for (const GazeSample& sample : record.samples(trial))
            all.push_back(sample);
    return all;
}

std::vector<GazeEvent> events_of_kind(const SessionRecord& record, GazeEvent::Kind kind) {
    std::vector<GazeEvent> all;
    for (const TrialRecord& trial : record.trials())
        record.read_gaze_events(trial, [&](const GazeEvent& event) {
            if (event.kind == kind)
                all.push_back(event);
        });
    return all;
}

std::int64_t lost_of(const std::vector<GazeSample>& samples) {
    return std::ranges::count_if(samples, [](const GazeSample& sample) { return !sample.gaze; });
}

void check_same(const std::vector<GazeSample>& a, const std::vector<GazeSample>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].sampled_at == b[i].sampled_at);
        REQUIRE(a[i].eye == b[i].eye);
        REQUIRE(a[i].gaze == b[i].gaze);
        REQUIRE(a[i].pupil_area == b[i].pupil_area);
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// Samples at these places, 500 Hz, from 1000 ms on, in a recording of the right eye, with pupils.
std::string made_recording(const std::vector<std::array<double, 3>>& values,
                           const std::string& kind = "GAZE") {
    std::string text = "** VERSION: EYELINK II 1\nMSG\t990 GAZE_COORDS 0.00 0.00 1279.00 1023.00\n"
                       "START\t1000 \tRIGHT\tSAMPLES\tEVENTS\nPUPIL\tAREA\n"
                       "EVENTS\tGAZE\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\nSAMPLES\t" +
                       kind + "\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\n";
    int ms = 1000;
    for (const auto& [x, y, pupil] : values) {
        text += fmt::format("{}\t{:7.1f}\t{:7.1f}\t{:7.1f}\t...\n", ms, x, y, pupil);
        ms += 2;
    }
    return text + fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  35.00\t  36.00\n", ms);
}

} // namespace

TEST_CASE("lost samples are lost, whatever edf2asc -miss wrote for them, in either eye", "[unit]") {
    ImportBench bench;
    for (const bool right : {false, true}) {
        AscExample example;
        example.right = right;
        const std::string sound = asc_text(example);
        const std::vector<GazeSample> expected = samples_of(bench.import(sound));
        for (const std::string miss : {"-1", "-1.0", "9999", "-9999", "0", "0.0", "500", "-32768.0", "1e8",
                                       "-", "--", "missing", "NA", "no data", "", "-nan(ind)", "NaN"}) {
            CAPTURE(right, miss);
            check_same(samples_of(bench.import(
                           replaced(sound, "\t   .\t   .\t", fmt::format("\t{0}\t{0}\t", miss)))),
                       expected);
            CHECK(bench.summary.survey.skipped_lines == 0);
            CHECK(bench.summary.survey.samples_without_gaze == (right ? 40 : 20));
            // Of samples alone, as edf2asc -s has them, and with pupils of a dot.
            std::string alone;
            for (const std::string& line : lines_of(sound))
                if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
                    alone += line + "\n";
            alone = replaced(alone, "\t   .\t   .\t    0.0", fmt::format("\t{0}\t{0}\t    0.0", miss));
            CHECK(lost_of(samples_of(bench.import(alone))) == (right ? 40 : 20));
        }
    }
    // One eye lost alone.
    AscExample both;
    both.right = true;
    const std::string lost = "\t   .\t   .\t    0.0", seen = "\t  200.0\t  300.0\t  900.0";
    const std::string left_alone = replaced(asc_text(both), lost + lost, "\t-1\t-1\t    0.0" + seen),
                      right_alone = replaced(asc_text(both), lost + lost, seen + "\t-1\t-1\t    0.0");
    CHECK(lost_of(samples_of(bench.import(left_alone))) == 20);
    CHECK(lost_of(samples_of(bench.import(right_alone))) == 20);
}

TEST_CASE("what looks like a missing value and is gaze stays gaze", "[unit]") {
    ImportBench bench;
    std::vector<std::array<double, 3>> values;
    for (int n = 0; n < 100; ++n)
        values.push_back({-50.0, -50.0, 1200.0}); // steadily off the screen
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 0);
    // One coordinate that is the missing value.
    for (int n = 20; n < 40; ++n)
        values[static_cast<std::size_t>(n)] = {-1.0, -1.0, 0.0};
    values[50] = {-1.0, 300.0, 1200.0};
    values[51] = {300.0, -1.0, 1200.0};
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 20);
    CHECK_THAT(bench.remarks(), Contains("Places of -1 are lost gaze"));
    // Named by whoever imports, where no sample tells.
    values.assign(100, {512.5, 400.5, 1200.0});
    values[7] = {777.0, 777.0, 1200.0};
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 0);
    bench.reading.missing = "777";
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 1);
}

TEST_CASE("a pupil below 15 is none, except where pupils are in another unit or were not recorded",
          "[unit]") {
    ImportBench bench;
    const auto lost_with = [&](const std::function<double(int)>& pupil) {
        std::vector<std::array<double, 3>> values;
        for (int n = 0; n < 100; ++n)
            values.push_back({400.0 + n, 300.0 + 0.1 * n, pupil(n)});
        return lost_of(samples_of(bench.import(made_recording(values))));
    };
    CHECK(lost_with([](int n) { return n < 30 ? 14.9 : 1200.0; }) == 30);
    CHECK(lost_with([](int n) { return n < 30 ? 0.0 : 15.0; }) == 30);
    CHECK(lost_with([](int) { return 3.6; }) == 0);
    CHECK_THAT(bench.remarks(), Contains("Pupils are not as EyeLinks have them"));
    CHECK(lost_with([](int) { return 0.0; }) == 0);
}

TEST_CASE("events carry the file's missing value as their samples do", "[unit]") {
    ImportBench bench;
    for (const std::string miss : {"-1.0", "9999", "-", "no data", "", "."}) {
        CAPTURE(miss);
        const std::string text =
            replaced(replaced(asc_text({}), "\t   .\t   .\t", fmt::format("\t{0}\t{0}\t", miss)),
                     "\t  512.8\t  -39.5\t  509.2\t  380.4\t   0.46",
                     fmt::format("\t   {0}\t   {0}\t  509.2\t  380.4\t 2.3e+06", miss));
        const std::vector<GazeEvent> saccades = events_of_kind(bench.import(text), GazeEvent::Kind::saccade);
        REQUIRE(saccades.size() == 2);
        CHECK_FALSE(saccades[0].place);
        CHECK(saccades[0].arrival == ScreenPoint{509.2, 380.4});
        CHECK_FALSE(saccades[0].amplitude_deg);
        CHECK(saccades[0].peak_velocity_deg_s == 57.0);
        CHECK(bench.summary.survey.unreadable_event_values == 0);
    }
}

TEST_CASE("field cases give their right values", "[unit]") {
    ImportBench bench;
    const std::vector<GazeSample> usual = samples_of(bench.field_case("a10b_utf8_bom"));
    REQUIRE(usual.size() == 100);
    CHECK(bench.summary.survey.skipped_lines == 0);
    CHECK_THAT(bench.summary.survey.header, Contains("CONVERTED FROM made.edf"));

    for (const char* const name : {"b_s_miss_-1.0", "b_s_miss_9999"}) {
        const std::vector<GazeSample> samples = samples_of(bench.field_case(name));
        CHECK(samples.size() == 1000);
        CHECK(lost_of(samples) == 60);
    }
    for (const char* const name : {"a25_miss_-9999", "a25_miss_-"}) {
        CHECK(lost_of(samples_of(bench.field_case(name))) == 30);
        CHECK(bench.summary.survey.skipped_lines == 0);
    }
    check_same(samples_of(bench.field_case("a30_decimal_comma")), usual);
    CHECK_THAT(bench.remarks(), Contains("100 lines of samples have decimal commas"));
    check_same(samples_of(bench.field_case("a26_comments")), usual);
    CHECK(bench.summary.survey.skipped_lines == 0);
    CHECK(bench.summary.survey.comments == 4);

    const SessionRecord left = bench.field_case("a36_l_option_reccfg_after");
    CHECK(left.eyes(1).left);
    CHECK_FALSE(left.eyes(1).right);
    CHECK(samples_of(left).size() == 100);

    const SessionRecord href = bench.field_case("a09_href_events");
    const std::vector<GazeEvent> fixations = events_of_kind(href, GazeEvent::Kind::fixation),
                                 saccades = events_of_kind(href, GazeEvent::Kind::saccade);
    REQUIRE(fixations.size() == 2);
    REQUIRE(saccades.size() == 2);
    CHECK(fixations[0].place == ScreenPoint{530.6, 400.0});
    CHECK(fixations[0].pupil == 1209.0);
    CHECK(saccades[0].place == ScreenPoint{530.5, 400.0});
    CHECK(saccades[0].arrival == ScreenPoint{590.1, 410.0});
    CHECK(saccades[0].amplitude_deg == 1.72);
    CHECK(saccades[0].peak_velocity_deg_s == 155.0);
    CHECK(bench.summary.survey.events_that_are_no_gaze == 0);

    const std::vector<GazeEvent> bad =
        events_of_kind(bench.field_case("a38_sacc_msvc"), GazeEvent::Kind::saccade);
    REQUIRE(bad.size() == 2);
    CHECK(bad[0].arrival == ScreenPoint{590.1, 410.0});
    CHECK_FALSE(bad[0].amplitude_deg);
    CHECK_FALSE(bad[0].peak_velocity_deg_s);
    CHECK_THAT(bench.remarks(), Contains("2 values of fixations and saccades were no numbers"));

    const std::vector<GazeSample> rounded = samples_of(bench.field_case("a17c_ftime_float32_1000hz"));
    REQUIRE(rounded.size() == 300);
    for (std::size_t i = 0; i < rounded.size(); ++i)
        CHECK(rounded[i].sampled_at.time_since_epoch().count() ==
              20'000'001'000 + 1000 * static_cast<std::int64_t>(i));
    CHECK_THAT(bench.remarks(), Contains("rounded times") && Contains("1000 Hz"));
}

TEST_CASE("events of the head's frame with resolutions have their gaze, and without gaze have no place",
          "[unit]") {
    ImportBench bench;
    std::string text = text_of(fs::path(OVERT_SOURCE_DIR) / "tests/data/asc/a09_href_events.asc");
    // RES puts the resolution at the end.
    const std::vector<GazeEvent> with_res = events_of_kind(
        bench.import(replaced(replaced(text, "530.6\t400.0\t1209\n", "530.6\t400.0\t1209\t35.0\t36.0\n"),
                              "1.72\t155\n", "1.72\t155\t35.0\t36.0\n")),
        GazeEvent::Kind::fixation);
    CHECK(with_res.at(0).place == ScreenPoint{530.6, 400.0});
    const SessionRecord alone = bench.import(replaced(text, "\t530.6\t400.0\t1209\n", "\n"));
    CHECK_FALSE(events_of_kind(alone, GazeEvent::Kind::fixation).at(0).place);
    CHECK(bench.summary.survey.events_that_are_no_gaze == 1);
}

TEST_CASE("times rounded to single precision are told by the rate", "[unit]") {
    ImportBench bench;
    for (const double rate_hz : {250.0, 500.0, 1000.0, 2000.0})
        for (const std::int64_t start_ms :
             {8'388'607, 8'388'609, 16'777'215, 16'777'217, 20'000'003, 33'554'431, 33'554'435, 50'000'001}) {
            CAPTURE(rate_hz, start_ms);
            constexpr int count = 400;
            const auto interval_us = static_cast<std::int64_t>(1e6 / rate_hz);
            std::string text = fmt::format("START\t{} \tLEFT\tSAMPLES\tEVENTS\n"
                                           "SAMPLES\tGAZE\tLEFT\tRATE\t{:.2f}\tTRACKING\tCR\n",
                                           start_ms, rate_hz);
            std::vector<std::int64_t> true_us;
            for (int n = 0; n < count; ++n) {
                true_us.push_back(1000 * start_ms + interval_us * n);
                const auto rounded = static_cast<float>(1e-3 * static_cast<double>(true_us.back()));
                text += fmt::format("{:.1f}\t  500.5\t  400.5\t 1000.0\t...\n", rounded);
            }
            text += fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  38.00\t  38.00\n",
                                start_ms + interval_us * count / 1000 + 1);
            const std::vector<GazeSample> samples = samples_of(bench.import(text));
            CHECK(bench.summary.survey.skipped_lines == 0);
            REQUIRE(samples.size() == static_cast<std::size_t>(count));
            for (int n = 0; n < count; ++n)
                REQUIRE(samples[static_cast<std::size_t>(n)].sampled_at.time_since_epoch().count() ==
                        true_us[static_cast<std::size_t>(n)]);
        }
}

TEST_CASE("a gap in rounded times stays one, and no time is farther off than the rounding", "[unit]") {
    ImportBench bench;
    std::string text; // no START, no rate
    std::vector<std::int64_t> true_ms;
    for (int n = 0; n < 600; ++n) {
        true_ms.push_back(20'000'001 + n + (n >= 300 ? 5000 : n >= 200 ? 7 : 0));
        text += fmt::format("{:.1f}\t  500.5\t  400.5\t 1000.0\t...\n", static_cast<float>(true_ms.back()));
    }
    const std::vector<GazeSample> samples = samples_of(bench.import(text));
    REQUIRE(samples.size() == true_ms.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        CHECK(std::abs(samples[i].sampled_at.time_since_epoch().count() - 1000 * true_ms[i]) <= 1000);
}

TEST_CASE("an import that would lose more than it may is refused, in all or of one recording", "[unit]") {
    ImportBench bench;
    AscExample example;
    const std::string sound = asc_text(example);
    const auto broken = [&](int from, int to, const char* begin) {
        std::string text;
        int n = 0;
        for (const std::string& line : lines_of(sound))
            text +=
                (line.starts_with(begin) && ++n > from && n <= to ? line.substr(0, 9) + "\tx" : line) + "\n";
        return text;
    };
    CHECK(samples_of(bench.import(broken(0, 6, "5"))).size() == 114);
    CHECK(bench.summary.survey.recordings.size() == 3);
    CHECK(bench.summary.survey.recordings[1].sample_lines == 60);
    CHECK(bench.summary.survey.recordings[1].samples_read == 54);
    CHECK(bench.summary.survey.recordings[2].samples_read == 60);
    const std::string bad = broken(0, 8, "5"), worse = broken(0, 14, "5"), no_events = broken(0, 9, "E");
    CHECK_THROWS_WITH(bench.import(bad),
                      Contains("52 of 60 lines of samples of the recording that began at 5000 ms") &&
                          Contains("--least-read"));
    CHECK_THROWS_WITH(bench.import(worse), Contains("106 of 120 lines of samples"));
    CHECK_THROWS_WITH(bench.import(no_events), Contains("lines of fixations, saccades and blinks"));
    CHECK_FALSE(fs::exists(bench.root.path() / fmt::format("session_{}", bench.sessions)));
    bench.reading.least_read = 0.7;
    CHECK(samples_of(bench.import(worse)).size() == 106);
    bench.reading.least_read = 0.0;
    CHECK(samples_of(bench.import(no_events)).size() == 120);
}

TEST_CASE("two files of different recordings are refused", "[unit]") {
    ImportBench bench;
    AscExample example;
    const auto halves = [&](const std::string& text, const std::string& name) {
        std::string of_samples, of_events;
        for (const std::string& line : lines_of(text))
            (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])) ? of_samples : of_events) +=
                line + "\n";
        return std::pair{bench.file(name + "_s.asc", of_samples), bench.file(name + "_e.asc", of_events)};
    };
    // The example's own fixation lies elsewhere: give it the place of its samples.
    const std::string text = replaced(asc_text(example), "\t  512.8\t  394.5\t   1063",
                                      "\t  101.7\t  694.9\t   1063"),
                      second = replaced(text, "EFIX L   7030\t7038\t10\t  101.7",
                                        "EFIX L   7030\t7038\t10\t  201.7");
    const auto one = halves(second, "one");
    CHECK(samples_of(bench.import(AscFiles(one.first, one.second))).size() == 120);
    // Another hour of the tracker's clock.
    std::string later = second;
    for (const char* const thousand : {"5", "7"})
        later = replaced(later, fmt::format("\n{}", thousand), fmt::format("\n1{}", thousand));
    const auto other = halves(later, "other");
    CHECK_THROWS_WITH(bench.import(AscFiles(other.first, one.second)), Contains("not of one recording"));
    // The same time, another observer.
    const auto elsewhere =
        halves(replaced(replaced(second, "\t  101.", "\t  901."), "\t  201.", "\t  801."), "where");
    CHECK_THROWS_WITH(bench.import(AscFiles(elsewhere.first, one.second)),
                      Contains("other places than the samples"));
}

TEST_CASE("samples that are no gaze are refused by name, with what helps", "[unit]") {
    ImportBench bench;
    std::vector<std::array<double, 3>> raw, angles;
    for (int n = 0; n < 100; ++n) {
        raw.push_back({300.0 + n, 200.0 + n, -900.0});
        angles.push_back({-2000.0 + 30 * n, -1500.0 + 3 * n, 900.0});
    }
    CHECK_THROWS_WITH(bench.import(made_recording(raw)), Contains("file_sample_raw_pcr"));
    CHECK_THROWS_WITH(bench.import(made_recording(angles, "HREF")), Contains("-sg"));
    CHECK_THROWS_WITH(bench.import(made_recording(raw, "PUPIL")), Contains("-sg"));
    std::string alone;
    for (const std::string& line : lines_of(made_recording(angles)))
        if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
            alone += line + "\n";
    CHECK_THROWS_WITH(bench.import(alone), Contains("lie off the screen") && Contains("--as-gaze"));
    bench.reading.is_gaze = true;
    CHECK(samples_of(bench.import(alone)).size() == 100);
    bench.reading.least_read = 0.0;
    CHECK(lost_of(samples_of(bench.import(made_recording(raw)))) == 100);
    CHECK(samples_of(bench.import(made_recording(angles, "HREF"))).empty());
}

TEST_CASE("a line of one eye in a recording of both is that eye's", "[unit]") {
    ImportBench bench;
    const auto with_events = [](const char* eye) {
        std::string text = "START\t1000 \tLEFT\tRIGHT\tSAMPLES\tEVENTS\n"
                           "SAMPLES\tGAZE\tLEFT\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\n";
        for (int n = 0; n < 100; ++n) {
            if (n == 50 && *eye != '\0')
                text += fmt::format("SFIX {}   {}\n", eye, 1000 + 2 * n);
            text += n < 50 ? fmt::format("{}\t  100.0\t  300.0\t  900.0\t  180.0\t  310.0\t  950.0\t.....\n",
                                         1000 + 2 * n)
                           : fmt::format("{}\t  170.0\t  309.0\t  950.0\t...\n", 1000 + 2 * n);
        }
        return text + "END\t1201 \tSAMPLES\tEVENTS\tRES\t  38.00\t  38.00\n";
    };
    for (const auto& [event, expected] : {std::pair{"", Eye::right}, {"L", Eye::left}, {"R", Eye::right}}) {
        CAPTURE(event);
        const std::vector<GazeSample> samples = samples_of(bench.import(with_events(event)));
        REQUIRE(samples.size() == 150);
        CHECK(samples.back().eye == expected);
        CHECK(samples.back().gaze == ScreenPoint{170.0, 309.0});
        CHECK(bench.summary.survey.skipped_lines == 0);
        CHECK_THAT(bench.remarks(), Contains("50 lines of samples have one eye's values"));
    }
    // Both eyes' where one was said; and a line of both that was cut off is still broken.
    const std::string said_one = replaced(with_events(""), "LEFT\tRIGHT", "LEFT");
    CHECK(samples_of(bench.import(said_one)).size() == 150);
    CHECK(bench.summary.survey.lines_of_both_eyes == 50);
    bench.import(replaced(with_events(""),
                          "1010\t  100.0\t  300.0\t  900.0\t  180.0\t  310.0\t  950.0\t.....",
                          "1010\t  100.0\t  300.0\t  900.0"));
    CHECK(bench.summary.survey.skipped_lines == 1);
}

TEST_CASE("files that are no plain text are refused by what they are, with the command that mends them",
          "[unit]") {
    ImportBench bench;
    const std::string text = asc_text({});
    std::string wide;
    for (const char c : text)
        wide += {c, '\0'};
    std::string wide_the_other_way;
    for (const char c : text)
        wide_the_other_way += {'\0', c};
    using namespace std::string_literals;
    for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::string>>{
             {"\xff\xfe" + wide, "UTF-16"},
             {"\xfe\xff" + wide_the_other_way, "UTF-16"},
             {wide, "UTF-16LE"},
             {wide_the_other_way, "UTF-16BE"},
             {"\xff\xfe\0\0"s + wide, "UTF-32"},
             {"\x1f\x8b\x08\x00\x00"s, "gzip -dc"},
             {"PK\x03\x04"s + text, "unzip"},
             {"BZh91AY", "bzip2"},
             {"\xfd"
              "7zXZ",
              "xz"},
             {replaced(text, "\n", "\r"), "carriage return"},
             {replaced(text, "\n", "\r") + "\n", "carriage return"}}) {
        CAPTURE(words);
        CHECK_THROWS_WITH(bench.import(bytes), Contains(words));
    }
    CHECK(samples_of(bench.import(replaced(text, "\n", "\r\n"))).size() == 120);
}

TEST_CASE("areas and diameters of pupils are told recording by recording", "[unit]") {
    ImportBench bench;
    const auto dictionary_of = [&](const SessionRecord& record) {
        const fs::path folder = bench.root.path() / fmt::format("tables_{}", bench.sessions);
        export_tables(
            record, [](const ViewedObject&) { return nullptr; }, folder);
        return text_of(folder / "dictionary.json");
    };
    const auto asc_of = [&](const SessionRecord& record) {
        const fs::path folder = bench.root.path() / fmt::format("asc_{}", bench.sessions);
        export_asc(record, folder, {});
        return text_of(folder / "sub-07_ses-01_run-01.asc");
    };
    const std::string both = "Pupil area; in trial 2 pupil diameter";
    const SessionRecord mixed = bench.field_case("a29_area_then_diameter");
    CHECK_THAT(dictionary_of(mixed),
               Contains("\"" + both + "\"") && Contains("Mean pupil size of a fixation. " + both));
    const std::string asc = asc_of(mixed);
    REQUIRE(asc.find("PUPIL\tAREA") != std::string::npos);
    REQUIRE(asc.find("PUPIL\tDIAMETER") != std::string::npos);
    CHECK(asc.find("PUPIL\tAREA") < asc.find("PUPIL\tDIAMETER"));
    CHECK(asc_of(bench.import(asc)) == asc);

    const std::string calibrated = text_of(fs::path(OVERT_SOURCE_DIR) / "tests/data/asc/c_cal.asc");
    CHECK_THAT(dictionary_of(bench.import(calibrated)), Contains("\"Pupil area\""));
    CHECK_THAT(dictionary_of(bench.import(replaced(calibrated, "PUPIL\tAREA", "PUPIL\tDIAMETER"))),
               Contains("\"Pupil diameter\""));
}
