/// `overt analyze` of recordings that were imported and know of no stimulus.
#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>
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

/// Analyses a session and gives what was said.
ProgramRun analysis_of_import(const fs::path& session, const fs::path& out) {
    return run_overt({"analyze", session.string(), "--format", "tsv", "--resamples", "100", "--permutations",
                      "100", "--out", out.string()});
}

} // namespace

TEST_CASE("an analysis of imported recordings gives fixations on the screen and quality, and says what not",
          "[session]") {
    const TemporaryFolder root;
    for (const bool has_samples : {true, false}) {
        AscExample example;
        example.has_samples = has_samples;
        const fs::path file = write_asc(root.path() / "p07.asc", asc_text(example)),
                       session = root.path() / (has_samples ? "whole" : "events"),
                       out = root.path() / (has_samples ? "whole_analysis" : "events_analysis");
        REQUIRE(run_overt({"import", file.string(), "--out", session.string(), "--screen-mm", "400", "300",
                           "--distance-mm", "600"})
                    .exit_code == 0);
        const ProgramRun run = analysis_of_import(session, out);
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        CHECK_THAT(run.out, Contains("2 no stimulus known") && Contains("knows of no stimulus") &&
                                Contains("tables fixations, quality and trials"));
        const TsvFile fixations(out / "fixations.tsv");
        REQUIRE(fixations.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(fixations.text(i, "why") == "no stimulus known");
            CHECK(fixations.number(i, "duration_s") == Approx(0.010));
            CHECK(fixations.number(i, "x_px") ==
                  Approx(has_samples ? example_x(static_cast<int>(i), 17, true) : 512.8));
            for (const char* const column : {"on_surface", "part", "x_mm", "angle_deg"})
                CHECK(fixations.text(i, column) == "n/a");
        }
        const TsvFile quality(out / "quality.tsv");
        CHECK(quality.size() > 0);
        if (has_samples)
            CHECK(quality.number(0, "samples") == 60);
        CHECK(fs::exists(out / "report.html"));
    }
}

TEST_CASE("imports of earlier programs, which have a motion of 61 frames and one pose, can be analysed",
          "[session]") {
    const TemporaryFolder root;
    const fs::path file = write_asc(root.path() / "p07.asc", asc_text({})), session = root.path() / "session";
    REQUIRE(run_overt({"import", file.string(), "--out", session.string()}).exit_code == 0);
    SQLite::Database((session / "session.sqlite").string(), SQLite::OPEN_READWRITE)
        .exec("PRAGMA foreign_keys = OFF;"
              "UPDATE session SET frame_count = 61, amplitude_deg = 25, duration_s = 8;"
              "DROP TABLE animation"); // which they did not have
    const ProgramRun run = analysis_of_import(session, root.path() / "analysis");
    INFO(run.err);
    CHECK(run.exit_code == 0);
}
