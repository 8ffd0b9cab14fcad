/// Gaze on two busts, brought to one of them, through the commands that a user types.
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

namespace {

/// Corners of the trunk and of the plinth, and the outermost places of the head, of both busts.
constexpr std::string_view corresponding = R"(
[[points]]
id = "build"
object = "bust"
near_mm = [[-70, -45, 190], [70, -45, 190], [-70, 45, 40], [70, 45, 40], [0, -62, 245], [0, -10, 297], [52, -10, 245], [-90, -60, 0], [90, 60, 0]]

[[points]]
id = "build"
object = "tall"
near_mm = [[-45, -40, 260], [45, -40, 260], [-45, 40, 40], [45, 40, 40], [0, -63, 310], [0, -15, 358], [48, -15, 310], [-60, -60, 0], [60, 60, 0]]
)";

constexpr const char* landmark_table =
    "object,landmark,x_mm,y_mm,z_mm\n"
    "bust,a,-70,-45,190\nbust,b,70,-45,190\nbust,c,0,-10,297\nbust,d,90,60,0\n"
    "tall,a,-45,-40,260\ntall,b,45,-40,260\ntall,c,0,-15,358\ntall,d,60,60,0\n";

} // namespace

TEST_CASE("gaze on two objects is analysed on the surface of one, where both can be compared", "[session]") {
    const SmallExperiment experiment(std::string(small_protocol) + std::string(corresponding));
    std::vector<std::string> sessions;
    for (const char* const observer : {"P01", "P02"}) {
        const ProgramRun run = experiment.run({"--observer", observer});
        INFO(run.err << run.out);
        REQUIRE(run.exit_code == 0);
        sessions.push_back(experiment.session(1, observer).string());
    }
    const auto analyze = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"analyze",
                                           sessions[0],
                                           sessions[1],
                                           "--format",
                                           "tsv",
                                           "--out",
                                           (experiment.folder().path() / out).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return experiment.overt(arguments);
    };
    REQUIRE(analyze("own", {"--by", "object"}).exit_code == 0);
    const ProgramRun run = analyze(
        "one", {"--by", "object", "--compare", "object", "--template", "bust", "--landmarks", "build"});
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find(
              "note: All places are on bust. Those on others were brought to it: tall (by 9 landmarks, "
              "of which each is told by the others to ") != std::string::npos);
    const fs::path one = experiment.folder().path() / "one";
    const TsvFile fit(one / "template_fit.tsv");
    REQUIRE(fit.size() == 2);
    CHECK(fit.text(0, "on_object") == "bust");
    CHECK(fit.text(0, "warp") == "the same surface");
    CHECK(fit.text(1, "on_object") == "tall");
    CHECK(fit.text(1, "warp") == "thin plate");
    CHECK(fit.number(1, "landmarks") == 9.0);
    CHECK(fit.number(1, "scale") > 1.0); // the bust is wider by half, and a sixth lower
    CHECK(fit.number(1, "scale") < 1.3);
    CHECK(fit.number(1, "away_mm") < 6.0);
    CHECK(fit.number(1, "turned_share") < 0.02);

    // Each fixation keeps its part; those on the tall bust come down to the bust.
    const TsvFile before(experiment.folder().path() / "own/fixations.tsv"), after(one / "fixations.tsv");
    REQUIRE(before.size() == after.size());
    int counted = 0, above = 0;
    for (std::size_t row = 0; row < after.size(); ++row) {
        if (after.text(row, "counted") != "1")
            continue;
        ++counted;
        CHECK(after.text(row, "part") == before.text(row, "part"));
        CHECK(after.number(row, "z_mm") < 297.1);
        above += before.number(row, "z_mm") > 297.1;
    }
    CHECK(counted > 40);
    CHECK(above > 3);

    // Maps of either object are on the one surface, and are compared there.
    const TsvFile maps(one / "maps.tsv");
    REQUIRE(maps.size() == 4); // by duration and by count
    std::set<std::string> areas;
    for (std::size_t row = 0; row < maps.size(); ++row)
        areas.insert(maps.text(row, "area_mm2"));
    CHECK(areas.size() == 1);
    const TsvFile pairs(one / "table1_pairs.tsv");
    REQUIRE(pairs.size() == 1);
    CHECK(pairs.text(0, "a") == "bust");
    CHECK(pairs.text(0, "b") == "tall");
    CHECK(pairs.number(0, "cc") > 0.3);
    CHECK(pairs.number(0, "observers") == 2.0);
    CHECK(text_of(one / "report.html").find("thin-plate spline in space (Bookstein 1989)") !=
          std::string::npos);

    // A table of landmarks does as well; what cannot be is said before anything is read or written.
    experiment.folder().file("faces.csv", landmark_table);
    const std::string faces = (experiment.folder().path() / "faces.csv").string();
    const ProgramRun by_table = analyze("table", {"--template", "bust", "--landmarks", faces});
    INFO(by_table.err << by_table.out);
    CHECK(by_table.exit_code == 0);
    CHECK(by_table.out.find("tall (by 4 landmarks; its surface lay ") != std::string::npos);
    const ProgramRun alone = analyze("alone", {"--landmarks", "build"});
    CHECK(alone.exit_code == 2);
    CHECK(alone.err.find("--template") != std::string::npos);
    const ProgramRun unknown = analyze("unknown", {"--template", "bust", "--landmarks", "eyes"});
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.err.find(
              "--landmarks eyes: of the landmarks of tall and the template bust, 0 of them correspond") !=
          std::string::npos);
    experiment.folder().file("faces.csv", "object,landmark,x_mm,y_mm\n");
    const ProgramRun faulty = analyze("faulty", {"--template", "bust", "--landmarks", faces});
    CHECK(faulty.exit_code == 2);
    CHECK(faulty.err.find("faces.csv:1:1: error: there is no column z_mm") != std::string::npos);
    for (const char* const folder : {"alone", "unknown", "faulty"})
        CHECK_FALSE(fs::exists(experiment.folder().path() / folder));
}
