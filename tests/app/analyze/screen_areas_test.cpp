/// `overt analyze` of recordings without a stimulus, with areas of the screen: a way of gaze that was planted
/// comes back.
#include <catch2/catch.hpp>

#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/support/asc_text.h"
#include "tests/support/program.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

struct PlantedLook {
    double x_px, y_px;
    int duration_ms;
};

/// A recording at 500 Hz whose trials each look at these places, one straight after the other; 20 ms between
/// two fixations are the saccade. `messages` stand in each trial, as `variable` does with the trial's number.
std::string asc_of_looks(const std::vector<std::vector<PlantedLook>>& trials,
                         const std::vector<std::string>& messages,
                         const std::vector<std::string>& variables) {
    std::string text = "** CONVERTED FROM somewhere.edf\n** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED\n**\n"
                       "MSG\t4000 DISPLAY_COORDS 0 0 999 499\n";
    int now_ms = 10000;
    for (std::size_t trial = 0; trial < trials.size(); ++trial) {
        text += fmt::format("MSG\t{0} TRIALID {1}\nMSG\t{0} RECCFG CR 500 2 1 L\n"
                            "MSG\t{0} GAZE_COORDS 0.00 0.00 999.00 499.00\n",
                            now_ms - 10, trial + 1);
        text += fmt::format("START\t{}\tLEFT\tSAMPLES\tEVENTS\nPRESCALER\t1\nPUPIL\tAREA\n"
                            "EVENTS\tGAZE\tLEFT\tRATE\t 500.00\tTRACKING\tCR\tFILTER\t2\n"
                            "SAMPLES\tGAZE\tLEFT\tRATE\t 500.00\tTRACKING\tCR\tFILTER\t2\nMSG\t{} SYNCTIME\n",
                            now_ms, now_ms);
        // Gaze is at its first place before its first fixation is told.
        for (const int first_ms = now_ms; now_ms < first_ms + 10; now_ms += 2)
            text += fmt::format("{}\t{:.1f}\t{:.1f}\t900.0\t...\n", now_ms, trials[trial][0].x_px,
                                trials[trial][0].y_px);
        for (const PlantedLook& look : trials[trial]) {
            const int end_ms = now_ms + look.duration_ms;
            text += fmt::format("SFIX L   {}\n", now_ms);
            for (int ms = now_ms; ms < end_ms; ms += 2)
                text += fmt::format("{}\t{:.1f}\t{:.1f}\t900.0\t...\n", ms, look.x_px, look.y_px);
            text += fmt::format("EFIX L   {}\t{}\t{}\t{:.1f}\t{:.1f}\t900\n", now_ms, end_ms - 2,
                                look.duration_ms, look.x_px, look.y_px);
            for (int ms = end_ms; ms < end_ms + 20; ms += 2)
                text += fmt::format("{}\t{:.1f}\t{:.1f}\t900.0\t...\n", ms, look.x_px, look.y_px);
            now_ms = end_ms + 20;
        }
        text += fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  35.24\t  35.17\n", now_ms);
        for (const std::string& message : messages)
            text += fmt::format("MSG\t{} {}\n", now_ms, message);
        text += fmt::format("MSG\t{} !V TRIAL_VAR condition {}\nMSG\t{} TRIAL_RESULT 0\n", now_ms,
                            variables[trial], now_ms + 1);
        now_ms += 1000;
    }
    return text;
}

const std::vector<std::string> two_areas{"!V IAREA RECTANGLE 1 0 0 250 500 face",
                                         "!V IAREA ELLIPSE 2 500 100 900 400 sign"};
const std::vector<std::vector<PlantedLook>> planted{
    {{100, 100, 200}, {120, 300, 100}, {700, 250, 300}, {400, 20, 150}, {100, 100, 250}},
    {{400, 20, 100}, {700, 250, 100}, {510, 110, 200}, {700, 260, 100}}};

fs::path imported(const TemporaryFolder& root, const std::string& name, const std::string& text) {
    const fs::path file = write_asc(root.path() / (name + ".asc"), text),
                   session = root.path() / ("session_" + name);
    const ProgramRun run = run_overt({"import", file.string(), "--out", session.string(), "--screen-mm",
                                      "400", "200", "--distance-mm", "600"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return session;
}

ProgramRun analyzed_areas(const std::vector<fs::path>& sessions, const fs::path& out,
                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"analyze"};
    for (const fs::path& session : sessions)
        words.push_back(session.string());
    for (const char* const word : {"--format", "tsv", "--resamples", "100", "--permutations", "100", "--out"})
        words.emplace_back(word);
    words.push_back(out.string());
    words.insert(words.end(), more.begin(), more.end());
    return run_overt(words);
}

std::size_t row_with(const TsvFile& table, const std::map<std::string, std::string>& values) {
    for (std::size_t row = 0; row < table.size(); ++row)
        if (std::all_of(values.begin(), values.end(),
                        [&](const auto& value) { return table.text(row, value.first) == value.second; }))
            return row;
    FAIL("there is no such row");
    return 0;
}

} // namespace

TEST_CASE("dwell, visits, first arrival and transitions of areas that a recording tells are those planted",
          "[session]") {
    const TemporaryFolder root;
    const fs::path session = imported(root, "p07", asc_of_looks(planted, two_areas, {"easy", "hard"})),
                   out = root.path() / "analysis";
    const ProgramRun run = analyzed_areas({session}, out, {"--by", "var_condition"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("in area face:"));

    const TsvFile trials(out / "screen_area_trials.tsv");
    CHECK(trials.size() == 6);
    const std::size_t face = row_with(trials, {{"trial", "1"}, {"area", "face"}});
    CHECK(trials.text(face, "var_condition") == "easy");
    CHECK(trials.integer(face, "fixations") == 3);
    CHECK(trials.integer(face, "visits") == 2);
    CHECK(trials.number(face, "dwell_s") == Approx(0.55));
    CHECK(trials.number(face, "dwell_share") == Approx(0.55));
    CHECK(trials.number(face, "visits_s") == Approx(0.57));
    CHECK(trials.number(face, "first_visit_s") == Approx(0.3));
    CHECK(trials.number(face, "first_arrival_s") == Approx(0.01).margin(0.002));
    CHECK(trials.number(face, "share_by_chance") == Approx(0.25));
    const std::size_t sign = row_with(trials, {{"trial", "1"}, {"area", "sign"}});
    CHECK(trials.number(sign, "first_arrival_s") == Approx(0.35).margin(0.002));
    CHECK(trials.number(sign, "share_by_chance") ==
          Approx(3.14159265 * 200.0 * 150.0 / 500000.0).epsilon(0.005));
    const std::size_t neither = row_with(trials, {{"trial", "1"}, {"area", "(none)"}});
    CHECK(trials.number(neither, "dwell_s") == Approx(0.15));
    CHECK(trials.number(neither, "share_by_chance") ==
          Approx(1.0 - trials.number(face, "share_by_chance") - trials.number(sign, "share_by_chance")));
    // (510, 110) is in the ellipse's box, and not in the ellipse.
    CHECK(trials.number(row_with(trials, {{"trial", "2"}, {"area", "sign"}}), "dwell_s") == Approx(0.2));
    const std::size_t unseen = row_with(trials, {{"trial", "2"}, {"area", "face"}});
    CHECK(trials.integer(unseen, "visits") == 0);
    CHECK(trials.text(unseen, "first_arrival_s") == "n/a");

    const TsvFile ways(out / "screen_area_transitions.tsv");
    CHECK(ways.integer(row_with(ways, {{"trial", "1"}, {"from_area", "face"}, {"to_area", "sign"}}),
                       "count") == 1);
    CHECK(ways.integer(row_with(ways, {{"trial", "1"}, {"from_area", "(none)"}, {"to_area", "face"}}),
                       "count") == 1);
    CHECK(ways.integer(row_with(ways, {{"trial", "2"}, {"from_area", "(none)"}, {"to_area", "sign"}}),
                       "count") == 2);
    CHECK(ways.size() == 5);

    const TsvFile groups(out / "screen_areas.tsv");
    const std::size_t all = row_with(groups, {{"var_condition", "all"}, {"area", "face"}});
    CHECK(groups.number(all, "dwell_share") == Approx(0.55 / 1.5));
    CHECK(groups.number(all, "visits") == Approx(1.0));
    CHECK(groups.number(all, "reached") == Approx(0.5));
    CHECK(groups.number(all, "first_arrival_s") == Approx(0.01).margin(0.002));
    CHECK(groups.number(row_with(groups, {{"var_condition", "hard"}, {"area", "face"}}), "dwell_share") ==
          0.0);

    // Nothing of surfaces is there, and the page says why.
    for (const char* const file :
         {"maps.tsv", "figure4_area_share.tsv", "figure5_distribution.tsv", "table1_pairs.tsv",
          "time_course.tsv", "gaze_motion.tsv", "factor_effects.tsv", "mixed_models.R"})
        CHECK_FALSE(fs::exists(out / file));
    CHECK(fs::exists(out / "figures" / "fixation_durations.svg"));
    CHECK_FALSE(fs::exists(out / "figures" / "figure_5.svg"));
    CHECK_THAT(run.out, Contains("were not computed of them"));
    std::ifstream stream(out / "study.json");
    const nlohmann::json study = nlohmann::json::parse(stream);
    std::string methods;
    for (const auto& paragraph : study["methods"])
        methods += paragraph["text"].get<std::string>() + "\n";
    CHECK_THAT(
        methods,
        Contains("Gaze was asked for 2 areas of the screen (face and sign), which 2 trials had.") &&
            Contains("no maps, shares of parts or comparisons of conditions on a surface were computed"));
}

TEST_CASE("areas of a file are of the trials that it names, and stand beside those of the recording",
          "[session]") {
    const TemporaryFolder root;
    const fs::path session = imported(root, "p07", asc_of_looks(planted, {}, {"easy", "hard"})),
                   out = root.path() / "out", file = root.path() / "areas.csv";
    std::ofstream(file) << "area,shape,left_px,top_px,right_px,bottom_px,from_s,until_s,var_condition\n"
                           "middle,rectangle,350,0,450,500,,,\nlate,rectangle,0,0,1000,500,0.55,,easy\n";
    const ProgramRun run = analyzed_areas({session}, out, {"--areas", file.string()});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const TsvFile trials(out / "screen_area_trials.tsv");
    CHECK(trials.size() == 5);
    CHECK(trials.number(row_with(trials, {{"trial", "2"}, {"area", "middle"}}), "dwell_s") == Approx(0.1));
    // The third fixation, from 0.35 to 0.65 s, began before it was there and was half over when it came.
    const std::size_t late = row_with(trials, {{"trial", "1"}, {"area", "late"}});
    CHECK(trials.integer(late, "fixations") == 2);
    CHECK(trials.number(late, "there_s") == Approx(1.108 - 0.55).margin(0.005));
    CHECK(trials.number(late, "share_by_chance") == Approx(0.558 / 1.108).margin(0.005));

    // An EyeLink file does for all trials.
    const fs::path ias = root.path() / "set.ias", again = root.path() / "again";
    std::ofstream(ias) << "RECTANGLE 1 350 0 450 500 middle\n";
    REQUIRE(analyzed_areas({session}, again, {"--areas", ias.string()}).exit_code == 0);
    CHECK(TsvFile(again / "screen_area_trials.tsv").size() == 4);
}

TEST_CASE("faulty areas are refused with their place, and what a recording has wrong is told", "[session]") {
    const TemporaryFolder root;
    const fs::path session = imported(
                       root, "p07",
                       asc_of_looks(planted,
                                    {"!V IAREA FILE sets/one.ias", "!V IAREA RECTANGLE 1 9 9 0 0 bad"},
                                    {"easy", "hard"})),
                   file = root.path() / "areas.csv";
    std::ofstream(file) << "area,shape,left_px,top_px,right_px,bottom_px\nface,rectangle,0,0,x,9\n";
    const ProgramRun faulty = analyzed_areas({session}, root.path() / "a", {"--areas", file.string()});
    CHECK(faulty.exit_code == 2);
    CHECK_THAT(faulty.err, Contains("areas.csv:2:20: error"));
    CHECK_FALSE(fs::exists(root.path() / "a"));
    std::ofstream(file) << "area,shape,left_px,top_px,right_px,bottom_px,mood\nface,rectangle,0,0,9,9,glad\n";
    const ProgramRun unknown = analyzed_areas({session}, root.path() / "b", {"--areas", file.string()});
    CHECK(unknown.exit_code == 2);
    CHECK_THAT(unknown.err, Contains("no trial has a column mood"));
    CHECK(analyzed_areas({session}, root.path() / "c", {"--areas", (root.path() / "none.ias").string()})
              .exit_code == 2);

    const ProgramRun told = analyzed_areas({session}, root.path() / "d");
    REQUIRE(told.exit_code == 0);
    CHECK_THAT(told.out, Contains("2 messages on areas of the screen cannot be read") &&
                             Contains("sets/one.ias: give such a file with --areas") &&
                             Contains("No area of the screen is known"));
    CHECK_FALSE(fs::exists(root.path() / "d" / "screen_areas.tsv"));
}
