/// Spreads planted in the gaze of simulated observers, through whole sessions: where a material draws gaze to
/// the middle of the object, WSS is as much smaller as it was planted.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

TEST_CASE("a spread of gaze that a material has comes back through whole sessions beside what was planted",
          "[session]") {
    std::string text = with(small_protocol, "duration_s = 1\n", "duration_s = 8\n");
    text = with(text, "rate_hz = 1000\n", "rate_hz = 500\nsimulated_accuracy_deg = 0.25\n");
    text = text.substr(0, text.find("[[task]]"));
    for (const std::string id : {"shape", "gloss"})
        text +=
            "[[task]]\nid = \"" + id + "\"\nquestion = \"What is it like?\"\nsimulated_head_share = 0.3\n\n";
    const SmallExperiment experiment(text + "[[simulated_effect]]\nmaterial = \"matt\"\nspread = -3\n");
    const fs::path study = experiment.folder().path() / "study";
    const ProgramRun run = experiment.overt({"replicate", experiment.protocol().string(), "--context",
                                             "osmesa", "--observers", "8", "--out", study.string()});
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Catch::Contains("times what was planted"));
    std::string table = text_of(study / "analysis/figure5_distribution.csv");
    std::ranges::replace(table, ',', '\t');
    std::erase(table, '\r');
    const TsvFile rows(experiment.folder().file("figure5.tsv", table));
    double found_log = 0.0, planted_log = 0.0; // of matt to smooth
    double bias_log = 0.0;
    int holding = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const double found = rows.number(row, "wss_mm2"), planted = rows.number(row, "planted_wss_mm2");
        CAPTURE(rows.text(row, "task"), rows.text(row, "object"), rows.text(row, "material"), found, planted);
        CHECK(found == Approx(planted).epsilon(0.3));
        holding += rows.number(row, "wss_mm2_low") <= planted && planted <= rows.number(row, "wss_mm2_high");
        const double sign = rows.text(row, "material") == "matt" ? 1.0 : -1.0;
        found_log += sign * std::log(found);
        planted_log += sign * std::log(planted);
        bias_log += std::log(found / planted);
    }
    REQUIRE(rows.size() == 8);
    const double pairs = 4.0;
    CAPTURE(planted_log / pairs, found_log / pairs, bias_log / 8.0, holding);
    CHECK(planted_log / pairs < -0.25);
    // Some 200 fixations a row: WSS is known to about a tenth, the mean over rows to a twentieth. The
    // tracker's errors add to it, most where it is small.
    CHECK(found_log / pairs == Approx(planted_log / pairs).margin(0.22));
    CHECK(bias_log / 8.0 > -0.08);
    CHECK(bias_log / 8.0 < 0.15);
    CHECK(holding >= 4); // of 8 intervals of 95 %; fewer have a chance of 0.04 %
}
