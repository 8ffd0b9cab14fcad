/// Recordings that other programs, other places and other options of edf2asc make, with their right values.
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/tables/table_export.h"
#include "tests/experiment/record/asc/field_case.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::field_case;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

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
    for (const std::string& alone : {left_alone, right_alone}) {
        CHECK(lost_of(samples_of(bench.import(alone))) == 20);
        CHECK_THAT(bench.remarks(), Contains("Places of -1 are lost gaze"));
    }
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
    // Two lost samples that stood on the diagonal are not what most have.
    for (int n = 0; n < 100; ++n)
        values[static_cast<std::size_t>(n)] = {400.0 + n, 300.0, n < 20 ? 0.0 : 1200.0};
    values[5] = values[6] = {512.0, 512.0, 0.0};
    values[60] = {512.0, 512.0, 1200.0};
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 20);
    // Named by whoever imports, where no sample tells.
    values.assign(100, {512.5, 400.5, 1200.0});
    values[7] = {777.0, 777.0, 1200.0};
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 0);
    bench.reading.missing = "777";
    CHECK(lost_of(samples_of(bench.import(made_recording(values)))) == 1);
}

TEST_CASE("a word for what is missing is it in either coordinate, and others are no numbers", "[unit]") {
    AscConventions conventions;
    conventions.missing_word = "lost";
    for (const auto& [x, y] :
         {std::pair{"lost", "300.0"}, {"300.0", "lost"}, {"lost", "."}, {"other", "other"}}) {
        CAPTURE(x, y);
        CHECK(place_of(x, y, conventions).is_valid);
        CHECK_FALSE(place_of(x, y, conventions).point);
    }
    CHECK_FALSE(place_of("other", "300.0", conventions).is_valid);
    CHECK_FALSE(place_of("lost", "other", conventions).is_valid);
    CHECK(place_of("10.5", "300.0", conventions).point == ScreenPoint{10.5, 300.0});
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
    // However many: a pupil of 0 is none in any unit.
    CHECK(lost_with([](int n) { return n < 70 ? 0.0 : 1200.0; }) == 70);
    CHECK(lost_with([](int) { return 3.6; }) == 0);
    CHECK_THAT(bench.remarks(), Contains("Pupils are not as EyeLinks have them"));
    // In another unit some are above it.
    CHECK(lost_with([](int n) { return n < 40 ? 16.0 : 9.0; }) == 0);
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
    // Where the place is missing, a size that is the same number is, too.
    std::string text = replaced(asc_text({}), "\t   .\t   .\t", "\t9999\t9999\t");
    text = replaced(text, "\t  512.8\t  394.5\t   1063", "\t9999\t9999\t9999");
    text = replaced(text, "\t  512.8\t  -39.5\t  509.2\t  380.4\t   0.46\t     57",
                    "\t9999\t9999\t  509.2\t  380.4\t   0.46\t9999");
    const SessionRecord record = bench.import(text);
    CHECK_FALSE(events_of_kind(record, GazeEvent::Kind::fixation).at(0).pupil);
    CHECK_FALSE(events_of_kind(record, GazeEvent::Kind::saccade).at(0).peak_velocity_deg_s);
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
    // Times with fractions have one, too.
    std::string halves = text_of(fs::path(OVERT_SOURCE_DIR) / "tests/data/asc/a30_decimal_comma.asc");
    halves = replaced(halves, "\n1000000\t", "\n1000000,5\t");
    CHECK(samples_of(bench.import(halves)).front().sampled_at == tracker_time(1'000'000'500));
    check_same(samples_of(bench.field_case("a26_comments")), usual);
    CHECK(bench.summary.survey.skipped_lines == 0);
    CHECK(bench.summary.survey.comments == 4);

    const SessionRecord left = bench.field_case("a36_l_option_reccfg_after");
    CHECK(left.eyes(1).left);
    CHECK_FALSE(left.eyes(1).right);
    CHECK(samples_of(left).size() == 100);

    // The other eye's, where the set-up came later and says both.
    std::string right_eye =
        text_of(fs::path(OVERT_SOURCE_DIR) / "tests/data/asc/a36_l_option_reccfg_after.asc");
    right_eye = replaced(right_eye, "\tLEFT\t", "\tRIGHT\t");
    const SessionRecord right = bench.import(right_eye);
    CHECK(right.eyes(1).right);
    CHECK_FALSE(right.eyes(1).left);

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
    const SessionRecord diameters = bench.import(replaced(calibrated, "PUPIL\tAREA", "PUPIL\tDIAMETER"));
    CHECK_THAT(dictionary_of(diameters), Contains("\"Pupil diameter\""));
    // Also of a recording whose begin is not in the file.
    CHECK(diameters.gaze_source(1)->pupil_is_diameter);
    CHECK(tracker_facts(diameters, 1).pupil == PupilMeasure::diameter);
    CHECK_FALSE(bench.import(calibrated).gaze_source(1)->pupil_is_diameter);
}
