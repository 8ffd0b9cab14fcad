/// A study of four areas that a protocol describes, through the commands that a user types.
#include <filesystem>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/whole_file.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

namespace {

/// The small experiment about one bust, without a head: the part of that name is called dome. Below it are
/// the trunk and, in its upper half, a shoulder.
std::string area_protocol() {
    std::string text = with(small_protocol, "duration_s = 1\n", "duration_s = 8\n");
    text = with(text, "rate_hz = 1000\n", "rate_hz = 500\nsimulated_accuracy_deg = 0.25\n");
    text = with(
        text, "mesh = \"meshes/bust.ply\"\n",
        "mesh = \"meshes/bust.ply\"\n"
        "areas = { crown = { planes = [[[0, 0, 245], [0, 0, 1]]] }, left = { groups = [\"dome\", \"trunk\"], "
        "planes = [[[0, 0, 0], [1, 0, 0]]] } }\n");
    text.erase(text.find("[[object]]\nid = \"tall\""),
               text.find("[[material]]\nid = \"smooth\"") - text.find("[[object]]\nid = \"tall\""));
    text = text.substr(0, text.find("[[task]]"));
    return text + "[[task]]\nid = \"free\"\nquestion = \"Look.\"\n"
                  "simulated_area_shares = { dome = 0.5, trunk = 0.3, foot = 0.2 }\n\n"
                  "[[task]]\nid = \"foot\"\nquestion = \"Look at the foot.\"\n"
                  "simulated_area_shares = { dome = 0.2, trunk = 0.2, foot = 0.6 }\n\n"
                  "[[simulated_effect]]\nmaterial = \"matt\"\narea = \"foot\"\narea_odds = 2\n";
}

overt::Mesh headless_bust() {
    overt::Mesh mesh = bust();
    mesh.part_names = {"trunk", "dome", "foot"};
    return mesh;
}

double number_of(const TsvFile& table, const std::vector<std::pair<std::string, std::string>>& where,
                 const std::string& column) {
    for (std::size_t row = 0; row < table.size(); ++row) {
        bool is_it = true;
        for (const auto& [name, value] : where)
            is_it = is_it && table.text(row, name) == value;
        if (is_it)
            return table.number(row, column);
    }
    FAIL("no row of " << column);
    return 0.0;
}

} // namespace

TEST_CASE("four areas of a protocol go through a whole study, planted shares come back, and nothing speaks "
          "of heads",
          "[session]") {
    const SmallExperiment experiment(area_protocol());
    overt::write_ply(experiment.folder().path() / "meshes/bust.ply", headless_bust());
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    INFO(check.err << check.out);
    CHECK(check.exit_code == 0);
    // Dome and left overlap; crown lies in the dome; left lies across.
    CHECK((check.err + check.out).find("\"left\" overlap") != std::string::npos);
    CHECK((check.err + check.out).find("\"crown\" and \"dome\" overlap") == std::string::npos);
    const fs::path study = experiment.folder().path() / "study";
    const ProgramRun run = experiment.overt({"replicate", experiment.protocol().string(), "--context",
                                             "osmesa", "--observers", "6", "--out", study.string()});
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("on the head") == std::string::npos);
    std::vector<std::string> arguments{"analyze",   "--by",  "task,material",
                                       "--format",  "tsv",   "--area",
                                       "foot,dome", "--out", (study / "groups").string()};
    for (const char* const observer : {"01", "02", "03", "04", "05", "06"})
        arguments.push_back((study / "sessions/small" / fmt::format("sub-{}_ses-01", observer)).string());
    const ProgramRun analysis = experiment.overt(arguments);
    INFO(analysis.err << analysis.out);
    REQUIRE(analysis.exit_code == 0);
    const TsvFile areas(study / "groups/areas.tsv");
    const auto of = [&](const char* area, const char* task, const char* material, const char* column) {
        return number_of(areas, {{"area", area}, {"task", task}, {"material", material}}, column);
    };
    for (const auto& [area, share] : {std::pair{"dome", 0.5}, {"trunk", 0.3}, {"foot", 0.2}}) {
        CAPTURE(area);
        CHECK(of(area, "free", "smooth", "corrected") == Approx(share).margin(0.15));
    }
    // Odds of 0.6 times 2 are those of 0.75.
    CHECK(of("foot", "foot", "matt", "corrected") == Approx(0.75).margin(0.15));
    CHECK(of("crown", "all", "all", "by_count") < of("dome", "all", "all", "by_count"));
    CHECK(of("left", "all", "all", "by_count") > 0.0);
    CHECK(of("foot", "all", "all", "share_of_exposure") > 0.0);
    // Figure 4 is of the area that was named first; tests are corrected over those that were named.
    const TsvFile figure(study / "groups/figure4_area_share.tsv"), pairs(study / "groups/area_pairs.tsv");
    for (std::size_t row = 0; row < figure.size(); ++row)
        CHECK(figure.text(row, "area") == "foot");
    CHECK(number_of(figure, {{"task", "all"}, {"material", "all"}}, "by_count") ==
          of("foot", "all", "all", "by_count"));
    for (std::size_t row = 0; row < pairs.size(); ++row)
        CHECK((pairs.text(row, "area") == "foot" || pairs.text(row, "area") == "dome"));
    CHECK(number_of(pairs, {{"area", "foot"}, {"task", "all"}}, "difference") *
              (pairs.text(0, "a") == "matt" ? 1.0 : -1.0) >
          0.0);
    CHECK(TsvFile(study / "groups/area_transitions.tsv").size() > 0);
    const auto text = [&](const char* file) { return overt::read_whole_file(study / "groups" / file); };
    for (const char* const file : {"dictionary.json", "study.json", "trials.tsv", "fixations.tsv"})
        CHECK(text(file).find("on the head") == std::string::npos);
    CHECK(text("trials.tsv").find("head") == std::string::npos);
    CHECK(text("report.html").find("No object has") == std::string::npos);
    const ProgramRun refused =
        experiment.overt({"analyze", "--area", "nose", "--out", (study / "x").string(), arguments.back()});
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("nose") != std::string::npos);
    CHECK(refused.err.find("dome") != std::string::npos);
}

TEST_CASE("areas that cannot be are refused where they are written, all at once", "[session]") {
    std::string text = with(small_protocol, "mesh = \"meshes/bust.ply\"\n",
                            "mesh = \"meshes/bust.ply\"\n[object.areas.far]\nspheres = [[0, 0, 9000, 5]]\n"
                            "[object.areas.cup]\ngroups = [\"handle\"]\n"
                            "[object.areas.\"a b\"]\nplanes = [[[0, 0, 0], [0, 0, 1]]]\n");
    text = with(text, "simulated_head_share = 1\n", "simulated_area_shares = { rim = 0.2 }\n");
    const SmallExperiment experiment(text);
    const ProgramRun run = experiment.overt({"check", experiment.protocol().string()});
    CHECK(run.exit_code == 2);
    INFO(run.err);
    CHECK(run.err.find("\"a b\" cannot be used in file names") != std::string::npos);
    const SmallExperiment named(with(text, "[object.areas.\"a b\"]", "[object.areas.top]"));
    const ProgramRun groups = named.overt({"check", named.protocol().string()});
    CHECK(groups.exit_code == 2);
    INFO(groups.err);
    CHECK(groups.err.find("area 'far' contains no triangle") != std::string::npos);
    CHECK(groups.err.find("area 'cup' is said to have the group 'handle'") != std::string::npos);
    CHECK(groups.err.find("no object has an area \"rim\"") != std::string::npos);
}
