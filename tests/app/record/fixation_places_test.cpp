/// Where exports say that fixations met the surface, against what an analysis says of the same sessions.
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/app/analyze/small_study.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Rows of fixations by trial, in the order of time.
using RowsOfTrials = std::map<std::string, std::vector<std::size_t>>;

} // namespace

TEST_CASE("exported fixations have the places, parts and reasons of an analysis without options",
          "[session]") {
    // A tracker that is off makes gaze miss the busts, and places that lie on two sheets of them.
    const SmallStudy study(
        with(small_protocol, "rate_hz = 1000", "rate_hz = 500\nsimulated_accuracy_deg = 0.8"));
    const TemporaryFolder folder;
    REQUIRE(study.analyze(folder.path() / "analysis").exit_code == 0);
    const TsvFile analysed(folder.path() / "analysis/fixations.tsv");
    std::size_t placed = 0, elsewhere = 0, compared = 0;
    for (std::size_t session = 0; session < study.sessions.size(); ++session) {
        const std::filesystem::path out = folder.path() / std::to_string(session);
        REQUIRE(
            study.experiment.overt({"export", study.sessions[session], "--out", out.string()}).exit_code ==
            0);
        const TsvFile events(out / "gaze_events.tsv");
        RowsOfTrials exported;
        for (std::size_t row = 0; row < events.size(); ++row) {
            if (events.text(row, "kind") != "fixation") {
                CHECK_FALSE(events.has(row, "place"));
                CHECK_FALSE(events.has(row, "surface_x"));
                continue;
            }
            CHECK(events.has(row, "place"));
            if (events.text(row, "place") == "outside of the presentation") {
                CHECK_FALSE(events.has(row, "surface_x"));
                CHECK_FALSE(events.has(row, "part"));
                ++elsewhere;
            } else {
                exported[events.text(row, "trial")].push_back(row);
            }
        }
        RowsOfTrials of_analysis;
        for (std::size_t row = 0; row < analysed.size(); ++row)
            if (analysed.text(row, "observer") == "P0" + std::to_string(session + 1))
                of_analysis[analysed.text(row, "trial")].push_back(row);
        REQUIRE(exported.size() == of_analysis.size());
        for (const auto& [trial, rows] : of_analysis) {
            CAPTURE(session, trial);
            REQUIRE(exported[trial].size() == rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const std::size_t one = exported[trial][i], other = rows[i];
                ++compared;
                CHECK(events.text(one, "place") == analysed.text(other, "why"));
                CHECK(events.text(one, "part") == analysed.text(other, "part"));
                CHECK(events.has(one, "on_surface") == (analysed.integer(other, "samples") > 0));
                if (!events.has(one, "on_surface"))
                    continue;
                CHECK(events.number(one, "on_surface") ==
                      Approx(analysed.number(other, "on_surface")).margin(1e-4));
                CHECK(events.number(one, "within_reach") ==
                      Approx(analysed.number(other, "within_reach")).margin(1e-4));
                CHECK(events.has(one, "surface_x") == analysed.has(other, "x_mm"));
                CHECK(events.has(one, "surface_x") == events.has(one, "part"));
                if (!events.has(one, "surface_x"))
                    continue;
                ++placed;
                for (const char* axis : {"x", "y", "z"})
                    CHECK(analysed.number(other, std::string(axis) + "_mm") ==
                          Approx(events.number(one, std::string("surface_") + axis)).margin(1e-3));
            }
        }
    }
    CHECK(compared > 60);
    CHECK(placed > 40);
    CHECK(placed < compared); // some missed the busts
    CHECK(elsewhere > 0);
}
