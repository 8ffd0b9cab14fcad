/// What the benchmark of events says is what a user's commands give.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "tests/support/planted_asc.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

fs::path write_cut(const fs::path& file, bool tells_resolution = true, bool has_events = true) {
    const PlantedGaze gaze =
        plant_gaze({.rate_hz = 500.0, .duration_s = 20.0, .noise_deg = 0.02}, ScreenGeometry{});
    PlantedAsc around{.tells_resolution = tells_resolution, .has_events = has_events};
    for (int at_ms = 400; at_ms < 19'000; at_ms += 900)
        around.trial_ids_ms.push_back(at_ms);
    return write_planted_asc(file, gaze, around);
}

int fixations_in(const fs::path& table) {
    const test::TsvFile events(table);
    int fixations = 0;
    for (std::size_t i = 0; i < events.size(); ++i)
        fixations += events.text(i, "kind") == "fixation" && events.text(i, "detector") == "overt at export";
    return fixations;
}

double figure(const std::string& json, const std::string& name) {
    const nlohmann::json said = nlohmann::json::parse(json);
    for (const auto& one : said.at("figures"))
        if (one.at("figure") == name)
            return one.at("value").get<double>();
    FAIL("there is no figure \"" << name << "\" in " << json);
    return 0.0;
}

} // namespace

TEST_CASE("bench events counts what a user's import and export give", "[session]") {
    const test::TemporaryFolder root;
    const fs::path file = write_cut(root.path() / "cut.asc");
    const auto imported = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"import", file.string(), "--out", (root.path() / name).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::ProgramRun made = test::run_overt(arguments);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
    };
    const auto exported = [&](const std::string& name, const std::vector<std::string>& more) {
        const fs::path out = root.path() / ("tables_" + name);
        std::vector<std::string> arguments{"export", (root.path() / name).string(), "--out", out.string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::ProgramRun written = test::run_overt(arguments);
        INFO(written.err);
        REQUIRE(written.exit_code == 0);
        return fixations_in(out / "gaze_events.tsv");
    };
    const auto counted = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"bench", "events", file.string(), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return static_cast<int>(figure(test::run_overt(arguments).out, "cut.asc: fixations found"));
    };
    imported("plain", {});
    imported("noted", {"--detect-events"});
    const int usual = counted({});
    CHECK(usual > 20);
    CHECK(exported("plain", {"--detect-events", "--overwrite"}) == usual);
    CHECK(exported("noted", {}) == usual);
    const std::vector<std::string> dull{"--velocity-deg-s", "300", "--acceleration-deg-s2", "0"};
    const int fewer = counted(dull);
    CHECK(fewer < usual);
    imported("dull", {"--detect-events", dull[0], dull[1], dull[2], dull[3]});
    CHECK(exported("dull", {}) == fewer);
    fs::remove_all(root.path() / "tables_plain");
    CHECK(exported("plain", {"--detect-events", dull[0], dull[1], dull[2], dull[3]}) == fewer);
    // Not asked for, they are the tracker's.
    fs::remove_all(root.path() / "tables_plain");
    CHECK(exported("plain", {}) == 0);
}

TEST_CASE("where angles are unknown, --detect-events is refused with the remedy", "[session]") {
    const test::TemporaryFolder root;
    const fs::path file = write_cut(root.path() / "flat.asc", false, false), out = root.path() / "session";
    const test::ProgramRun made =
        test::run_overt({"import", file.string(), "--out", out.string(), "--detect-events"});
    CHECK(made.exit_code == 2);
    CHECK_THAT(made.err, Contains("flat.asc") && Contains("--screen-mm") && Contains("--distance-mm"));
    CHECK_FALSE(fs::exists(out));
    REQUIRE(test::run_overt({"import", file.string(), "--out", out.string()}).exit_code == 0);
    const fs::path tables = root.path() / "tables";
    const test::ProgramRun exported =
        test::run_overt({"export", out.string(), "--out", tables.string(), "--detect-events"});
    CHECK(exported.exit_code == 2);
    CHECK_THAT(exported.err, Contains("angles are unknown") && Contains("--screen-mm"));
    CHECK_FALSE(fs::exists(tables));
    // A threshold alone decides nothing, and one that cannot be is no threshold.
    CHECK(test::run_overt({"export", out.string(), "--out", tables.string(), "--velocity-deg-s", "20"})
              .exit_code == 2);
    CHECK(test::run_overt({"bench", "events", file.string(), "--velocity-deg-s", "0"}).exit_code == 2);
}

TEST_CASE("bench events gives no error of begin and end where no event has a partner", "[session]") {
    const test::TemporaryFolder root;
    // Labelled as one long saccade, of an eye that rests.
    std::ofstream table(root.path() / "resting.tsv");
    table << "# sampFreq=500 viewDist_m=0.67 screenW_m=0.38 screenH_m=0.3 resX=1024 resY=768\n"
             "sample\tt_ms\tx_px\ty_px\tAB\n";
    for (int i = 0; i < 500; ++i)
        table << i << '\t' << 2 * i << "\t500\t400\t2\n";
    table.close();
    const test::ProgramRun bench =
        test::run_overt({"bench", "events", (root.path() / "resting.tsv").string(), "--json"});
    CHECK_THAT(bench.out, Contains("saccades of the reference"));
    CHECK_THAT(bench.out, !Contains("median error"));
}

TEST_CASE(
    "bench events says how well two people agree with each other, and where the program differs from them",
    "[session]") {
    const test::TemporaryFolder root;
    // An eye that rests: the first person sees two saccades and a swing, the second one of the saccades.
    std::ofstream table(root.path() / "resting.tsv");
    table << "# sampFreq=500 viewDist_m=0.67 screenW_m=0.38 screenH_m=0.3 resX=1024 resY=768\n"
             "sample\tt_ms\tx_px\ty_px\tAB\tCD\n";
    for (int i = 0; i < 500; ++i) {
        const bool first = i >= 100 && i < 110, second = i >= 200 && i < 220, swing = i >= 110 && i < 115;
        table << i << '\t' << 2 * i << "\t500\t400\t"
              << (first || second ? 2
                  : swing         ? 3
                                  : 1)
              << '\t' << (first ? 2 : 1) << '\n';
    }
    table.close();
    const std::string said =
        test::run_overt({"bench", "events", (root.path() / "resting.tsv").string(), "--json"}).out;
    const std::string people = "two people against each other, 1 recordings: ",
                      all = "all 2 labellings by people: ";
    CHECK(figure(said, people + "saccade F1") == Approx(2.0 / 3.0));
    CHECK(figure(said, people + "saccades of the reference") == 2.0);
    CHECK(figure(said, people + "saccades found") == 1.0);
    CHECK(figure(said, all + "saccade samples of the person alone in saccades not found") == 100.0);
    CHECK(figure(said, all + "saccade samples of the program alone that are swings") == 0.0);
}
