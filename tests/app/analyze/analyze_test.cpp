/// `overt analyze` on whole sessions of simulated observers, whose truth is known.
#include <filesystem>
#include <regex>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/analyze/small_study.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

namespace {

/// Of the row over all tasks, objects and materials.
struct HeadShare {
    explicit HeadShare(const fs::path& analysis) {
        const TsvFile fractions(analysis / "figure4_area_share.tsv");
        for (std::size_t row = 0; row < fractions.size(); ++row) {
            if (fractions.text(row, "task") == "all" && fractions.text(row, "object") == "all" &&
                fractions.text(row, "material") == "all") {
                pooled = fractions.number(row, "pooled");
                low = fractions.number(row, "pooled_low");
                high = fractions.number(row, "pooled_high");
                if (fractions.has(row, "corrected_low")) {
                    corrected_low = fractions.number(row, "corrected_low");
                    corrected_high = fractions.number(row, "corrected_high");
                }
            }
        }
        const TsvFile fixations(analysis / "fixations.tsv");
        for (std::size_t row = 0; row < fixations.size(); ++row) {
            only_by_reach += fixations.text(row, "only_by_reach") == "1";
            counted += fixations.text(row, "counted") == "1";
        }
    }
    double pooled = -1.0, low = -1.0, high = -1.0;
    double corrected_low = -1.0, corrected_high = -1.0; ///< -1: there is none
    int only_by_reach = 0, counted = 0;
};

} // namespace

TEST_CASE("head fixations that the tracker's error moves off the outline count within the reach",
          "[session]") {
    // Half of the fixations go to the head whatever the question. The same observers look the same way at
    // trackers without an error and with twice the usual one: what is found without it is the truth.
    std::string exact = with(small_protocol, "duration_s = 1\n", "duration_s = 6\n");
    exact = with(exact, "simulated_head_share = 1\n", "simulated_head_share = 0.5\n");
    exact = with(exact, "simulated_head_share = 0\n", "simulated_head_share = 0.5\n");
    exact = with(exact, "rate_hz = 1000\n", "rate_hz = 1000\nsimulated_accuracy_deg = 0\n");
    const SmallStudy study(with(exact, "accuracy_deg = 0\n", "accuracy_deg = 0.6\n"));
    const fs::path folder = study.experiment.folder().path();

    REQUIRE(SmallStudy(exact).analyze(folder / "exact").exit_code == 0);
    REQUIRE(study.analyze(folder / "met", {"--reach", "0"}).exit_code == 0);
    const ProgramRun run = study.analyze(folder / "near", {"--json"});
    REQUIRE(run.exit_code == 0);
    const HeadShare truth(folder / "exact"), met(folder / "met"), near(folder / "near");
    INFO("without error: " << truth.pooled << " of " << truth.counted << "; met: " << met.pooled << " of "
                           << met.counted << "; within reach: " << near.pooled << " of " << near.counted
                           << ", " << near.only_by_reach << " only by it");
    CHECK(truth.low < 0.5);
    CHECK(truth.high > 0.5);
    CHECK(truth.corrected_low == -1.0); // the validation found no error to be taken out
    CHECK(truth.only_by_reach == 0);
    CHECK(met.high < truth.pooled);
    CHECK(near.pooled > met.pooled);
    // Whether by the reach or not, what was measured is the same.
    CHECK(near.corrected_low < 0.5);
    CHECK(near.corrected_high > 0.5);
    CHECK(met.corrected_low == near.corrected_low);
    CHECK(met.only_by_reach == 0);
    CHECK(near.only_by_reach > 0);
    CHECK(near.only_by_reach <= near.counted - met.counted);
    const auto json = nlohmann::json::parse(run.out);
    CHECK(json.at("only_by_reach") == near.only_by_reach);
    CHECK(run.out.find("only because samples that miss") != std::string::npos);
    CHECK(run.out.find("\"reach\"") != std::string::npos);

    CHECK(study.analyze(folder / "wrong", {"--reach", "-1"}).exit_code == 2);
}

TEST_CASE("where simulated observers mean to look comes back as head fractions", "[session]") {
    const SmallStudy study;
    const fs::path out = study.experiment.folder().path() / "analysis";
    const ProgramRun run = study.analyze(out);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    // The question about the face has all planned fixations on the head, that about the clothes none.
    int rows = 0;
    const TsvFile fractions(out / "figure4_area_share.tsv");
    for (std::size_t row = 0; row < fractions.size(); ++row) {
        if (fractions.text(row, "object") != "all" || fractions.text(row, "material") != "all")
            continue;
        const std::string task = fractions.text(row, "task");
        if (task == "face" || task == "clothes") {
            const double truth = task == "face" ? 1.0 : 0.0;
            CHECK(fractions.number(row, "corrected_low") <= truth);
            CHECK(fractions.number(row, "corrected_high") >= truth);
            CHECK(fractions.text(row, "observers") == "3");
            ++rows;
        }
    }
    CHECK(rows == 2);

    // The sum of the variances is WSS, in both units, and nothing is NaN anywhere.
    const TsvFile distributions(out / "figure5_distribution.tsv");
    CHECK(distributions.size() == 12);
    int spread = 0;
    for (std::size_t row = 0; row < distributions.size(); ++row) {
        if (!distributions.has(row, "wss_mm2"))
            continue; // one fixation alone has no spread
        ++spread;
        const double sum = distributions.number(row, "var_x_mm2") + distributions.number(row, "var_y_mm2") +
                           distributions.number(row, "var_z_mm2");
        CHECK(distributions.number(row, "wss_mm2") == Approx(sum).epsilon(1e-6));
    }
    CHECK(spread >= 10);
    CHECK(fs::exists(out / "report.html"));
    CHECK(fs::exists(out / "figures/figure_4.svg"));
    for (const fs::directory_entry& file : fs::directory_iterator(out)) {
        if (file.path().extension() != ".tsv")
            continue;
        const std::string text = text_of(file.path());
        INFO(file.path());
        // As a word of its own: "luminance" has the letters, too.
        CHECK_FALSE(std::regex_search(text, std::regex(R"(\b(nan|inf)\b)")));
    }
    const TsvFile maps(out / "maps.tsv");
    CHECK(maps.size() == 24); // by duration and by count
    // The light that fixations met, over all and in each level of the three columns.
    const TsvFile lights(out / "light_at_gaze.tsv");
    REQUIRE(lights.size() == 1 + 3 + 2 + 2);
    for (std::size_t row = 0; row < lights.size(); ++row) {
        CHECK(lights.text(row, "observers") == "3");
        CHECK(std::abs(lights.number(row, "lightness")) < 3.0);
        // Simulated observers do not mind the light.
        CHECK(std::abs(lights.number(row, "over_place")) < 0.5);
        CHECK(std::abs(lights.number(row, "over_point")) < 0.5);
    }
    const TsvFile trials(out / "trials.tsv");
    CHECK(trials.size() == 3 * small_trials);
    // The page has a trace of each trial, with the amplitude and the peak velocity of each saccade.
    const std::string page = text_of(out / "report.html"),
                      begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = page.find(begin) + begin.size();
    const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    CHECK(data.at("traces").size() == 3 * small_trials);
    int saccades = 0, with_peak = 0, with_one_alone = 0;
    for (const auto& trace : data.at("traces")) {
        for (const auto& event : trace.at("events")) {
            saccades += event[0] == "s";
            with_peak += event[0] == "s" && event[3].is_number() && event[4].is_number();
            with_one_alone += event[0] == "s" && event[3].is_number() != event[4].is_number();
        }
    }
    CHECK(saccades > 3 * small_trials);
    // One that is hidden by a blink as a whole has neither.
    CHECK(with_one_alone == 0);
    CHECK(10 * with_peak > 9 * saccades);
    // Maps keep what fixations put into them: ms of a trial.
    double fixated_s = 0.0;
    for (std::size_t row = 0; row < trials.size(); ++row)
        fixated_s += trials.number(row, "fixated_s");
    double in_maps_s = 0.0;
    for (std::size_t row = 0; row < maps.size(); ++row) {
        if (maps.text(row, "weighting") == "duration")
            in_maps_s += 1e-3 * maps.number(row, "total") * maps.number(row, "trials");
    }
    CHECK(in_maps_s == Approx(fixated_s).epsilon(1e-5));

    SECTION("a second analysis gives the same bytes, and replaces nothing unasked") {
        const fs::path again = study.experiment.folder().path() / "again";
        REQUIRE(study.analyze(again).exit_code == 0);
        for (const fs::directory_entry& file : fs::directory_iterator(out)) {
            if (!file.is_regular_file())
                continue;
            INFO(file.path());
            CHECK(text_of(file.path()) == text_of(again / file.path().filename()));
        }
        CHECK(study.analyze(out).exit_code == 2);
        CHECK(study.analyze(out, {"--overwrite"}).exit_code == 0);
    }
    SECTION("any column makes groups, and a wrong one is named with those there are") {
        const fs::path by = study.experiment.folder().path() / "by";
        REQUIRE(study.analyze(by, {"--by", "observer,attempt"}).exit_code == 0);
        const TsvFile of_observers(by / "figure4_area_share.tsv");
        CHECK(of_observers.text(0, "observer") == "P01");
        const ProgramRun wrong = study.analyze(by / "x", {"--by", "colour"});
        CHECK(wrong.exit_code == 2);
        CHECK(wrong.err.find("colour") != std::string::npos);
        CHECK(wrong.err.find("material") != std::string::npos);
        CHECK(study.analyze(by / "x", {"--sigma", "-2deg"}).exit_code == 2);
        const ProgramRun compared = study.analyze(by / "x", {"--compare", "task,material"});
        CHECK(compared.exit_code == 2);
        CHECK(compared.err.find("takes one of the columns of --by, which are task, object, material") !=
              std::string::npos);
    }
    SECTION("sessions without the light of their stimuli have no table of it") {
        for (const std::string& session : study.sessions) {
            for (const auto& file : fs::directory_iterator(fs::path(session) / "stimuli")) {
                if (file.path().extension() == ".exr")
                    fs::remove(file.path());
            }
        }
        const fs::path dark = study.experiment.folder().path() / "dark";
        REQUIRE(study.analyze(dark).exit_code == 0);
        CHECK_FALSE(fs::exists(dark / "light_at_gaze.tsv"));
        CHECK(text_of(dark / "fixations.tsv") == text_of(out / "fixations.tsv"));
    }
    SECTION("a session whose maps are gone is said, not counted, and does not end the analysis") {
        fs::remove_all(fs::path(study.sessions[0]) / "maps");
        const fs::path rest = study.experiment.folder().path() / "rest";
        const ProgramRun one =
            study.experiment.overt({"analyze", study.sessions[0], "--out", rest.string(), "--json"});
        INFO(one.err);
        REQUIRE(one.exit_code == 0);
        const auto json = nlohmann::json::parse(one.out);
        CHECK(json.at("counted_fixations") == 0);
        CHECK(one.out.find("cannot be used") != std::string::npos);
        CHECK(one.out.find("1 observer") != std::string::npos);
    }
}
