/// Characterising a simulated display by the program itself, and running an experiment on it.
#include <catch2/catch.hpp>

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/file_set.h"
#include "app/display/patch_photometers.h"
#include "devices/simulated/simulated_display.h"
#include "experiment/base/error.h"
#include "experiment/colour/characterisation_fit.h"
#include "experiment/protocol/files/characterisation_file.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

/// `overt display characterise --simulate-photometer 3` on the small experiment's screen.
ProgramRun characterise(const SmallExperiment& experiment, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"display",
                                       "characterise",
                                       experiment.protocol().string(),
                                       "--simulate-photometer",
                                       "3",
                                       "--context",
                                       "osmesa",
                                       "--out",
                                       (experiment.folder().path() / "d.toml").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment.overt(arguments);
}

std::optional<DisplayCharacterisation> read(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    auto display = read_characterisation(file, file.string(), {}, diagnostics);
    INFO(diagnostics.print());
    CHECK(diagnostics.findings().empty());
    return display;
}

} // namespace

TEST_CASE("a simulated display goes through OpenGL and the photometer into a file that tells its truth",
          "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = characterise(experiment, {"--name", "the lab's", "--json"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto printed = nlohmann::json::parse(run.out);
    for (const auto& figure : printed.at("figures")) {
        if (figure.contains("holds"))
            CHECK(figure["holds"].get<bool>());
    }
    const std::filesystem::path folder = experiment.folder().path();
    const auto display = read(folder / "d.toml");
    REQUIRE(display);
    CHECK(display->display == "the lab's");
    CHECK(display->screen.width_px == 544);
    CHECK(display->screen.viewing_distance_mm == 573.0);
    const DisplayTruth truth = DisplayTruth::drawn(3);
    for (const double grey : {0.25, 0.5, 0.75, 1.0}) {
        const glm::dvec3 is = truth.xyz_of(glm::dvec3(grey)), said = display->xyz_of_signal(glm::dvec3(grey));
        CHECK(said.y == Approx(is.y).epsilon(0.005));
        CHECK(chromaticity_of(said).x == Approx(chromaticity_of(is).x).margin(0.001));
        CHECK(chromaticity_of(said).y == Approx(chromaticity_of(is).y).margin(0.001));
    }
    // Its readings alone give the same light and curves.
    const ProgramRun again =
        experiment.overt({"display", "characterise", "--readings", (folder / "d_readings.csv").string(),
                          "--out", (folder / "e.toml").string()});
    INFO(again.err);
    REQUIRE(again.exit_code == 0);
    const auto same = read(folder / "e.toml");
    REQUIRE(same);
    CHECK(same->black_xyz == display->black_xyz);
    for (int i = 0; i <= 100; ++i)
        CHECK(same->xyz_of_signal(glm::dvec3(0.01 * i)) == display->xyz_of_signal(glm::dvec3(0.01 * i)));
    CHECK_FALSE(std::filesystem::exists(folder / "d_readings_partial.csv"));
    // Nothing is replaced unasked.
    const std::string before = text_of(folder / "d.toml");
    const ProgramRun refused = characterise(experiment);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("--overwrite") != std::string::npos);
    CHECK(text_of(folder / "d.toml") == before);
    CHECK(characterise(experiment, {"--overwrite", "--name", "another"}).exit_code == 0);
    CHECK(text_of(folder / "d.toml") != before);
}

TEST_CASE("an experiment runs on a characterised display: checked, verified in the signal, and on record",
          "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "background = 0.1", "background_cd_m2 = 12\ncharacterisation = \"d.toml\""));
    // A protocol that names a file cannot be read before it is there.
    CHECK(characterise(experiment).exit_code == 2);
    const SmallExperiment plain;
    REQUIRE(characterise(plain, {"--levels", "9", "--mixed", "3", "--repeats", "1"}).exit_code <= 1);
    std::filesystem::copy_file(plain.folder().path() / "d.toml", experiment.folder().path() / "d.toml");
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string(), "--json"});
    INFO(check.err);
    REQUIRE(check.exit_code == 0);
    const auto light = nlohmann::json::parse(check.out)["design"]["light"];
    CHECK(light["white_cd_m2"].get<double>() == Approx(100.0).epsilon(0.2));
    CHECK(light["background_cd_m2"].get<double>() == Approx(12.0));
    const ProgramRun text = experiment.overt({"check", experiment.protocol().string()});
    CHECK(text.out.find("contrast") != std::string::npos);
    const ProgramRun run = experiment.run({"--trials", "1", "--verify-output"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const ProgramRun show = experiment.overt({"show", experiment.session().string(), "--json"});
    REQUIRE(show.exit_code == 0);
    const auto recorded = nlohmann::json::parse(show.out)["characterisation"];
    CHECK(recorded["sha256"] == light["sha256"]);
    CHECK(recorded["white_cd_m2"].get<double>() == Approx(light["white_cd_m2"].get<double>()));
}

TEST_CASE("channels that do not add up are reported with exit code 1, and the file is there", "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = characterise(experiment, {"--crosstalk", "0.1", "--repeats", "1"});
    CHECK(run.exit_code == 1);
    CHECK(run.out.find("MISSED") != std::string::npos);
    CHECK(run.err.find("misses this display") != std::string::npos);
    CHECK(std::filesystem::exists(experiment.folder().path() / "d.toml"));
}

TEST_CASE("readings that cannot be used are refused at their places, and nothing is written", "[session]") {
    const SmallExperiment experiment;
    const TemporaryFolder& folder = experiment.folder();
    const auto refused = [&](const std::string& table, const std::string& words) {
        const ProgramRun run =
            experiment.overt({"display", "characterise", "--readings", folder.file("r.csv", table).string(),
                              "--out", (folder.path() / "f.toml").string()});
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK(run.err.find(words) != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder.path() / "f.toml"));
    };
    const std::string header = "level_r,level_g,level_b,X,Y,Z\n";
    refused(header + "0,0,0,0.1,0.1,0.1\n255,0,0,40,20,2\n", "r.csv:3:1: error: level_r of 255 is not in 0");
    refused(header + "0,0,0,0.1,-0.1,0.1\n", "r.csv:2:11: error: Y of -0.1 is below 0");
    refused(header + "1,0,0,40,20,2\n", "black was not read");
    refused("level_r,level_g,level_b,x,y,Y\n", "unknown column \"x\"");
    // Nobody types anything.
    const ProgramRun typed =
        experiment.overt({"display", "characterise", "--typed", "--context", "osmesa", "--settle", "0",
                          "--out", (folder.path() / "f.toml").string()});
    CHECK(typed.exit_code == 1);
    CHECK(typed.err.find("ended before any patch") != std::string::npos);
}

TEST_CASE("a colour goes to the display's light and codes, and back; what cannot be shown is counted",
          "[session]") {
    const SmallExperiment experiment;
    const TemporaryFolder& folder = experiment.folder();
    const std::string file = folder
                                 .file("d.toml", R"([light]
black = [0, 0, 0]
red = [40, 20, 2]
green = [35, 70, 12]
blue = [20, 10, 100]
[gamma]
exponent = 2
)")
                                 .string();
    const auto colours = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"display", "colour", file, "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(arguments);
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return nlohmann::json::parse(run.out);
    };
    // Half of white.
    const auto grey = colours({"--xyz", "47.5", "50", "57"});
    for (std::size_t channel = 0; channel < 3; ++channel) {
        CHECK(grey["colours"][0]["rgb"][channel].get<double>() == Approx(0.5));
        CHECK(grey["colours"][0]["codes_16bit"][channel] == 46340); // 65535 * sqrt(0.5) = 46340.24
    }
    CHECK(grey["outside"] == 0);
    const auto back = colours({"--rgb", "0.5", "0.5", "0.5"});
    CHECK(back["colours"][0]["xyz_1931"][1].get<double>() == Approx(50.0));
    std::string table = "wavelength_nm,dim,line\n";
    for (int nm = 380; nm <= 780; nm += 10)
        table += fmt::format("{},1e-4,{}\n", nm, nm == 520 ? 0.02 : 0.0);
    const auto spectra = colours({"--spectra", folder.file("s.csv", table).string()});
    CHECK(spectra["colours"].size() == 2);
    CHECK(spectra["colours"][0]["is_shown"] == true);
    CHECK(spectra["colours"][1]["is_shown"] == false);
    CHECK(spectra["outside"] == 1);
    CHECK(experiment.overt({"display", "colour", file, "--cones", "1", "1", "1"}).exit_code == 2);
    CHECK(experiment.overt({"display", "colour", file}).exit_code == 2);
    CHECK(experiment.overt({"display", "colour", "nowhere.toml", "--rgb", "1", "1", "1"}).exit_code == 2);
}

TEST_CASE("what is typed as XYZ is taken, and as xyY converted", "[unit]") {
    CHECK(typed_xyz("41.2 43.5 46.1") == glm::dvec3(41.2, 43.5, 46.1));
    CHECK(typed_xyz("41.2, 43.5, 46.1") == glm::dvec3(41.2, 43.5, 46.1));
    const auto converted = typed_xyz("xyY 0.3127 0.3290 100");
    REQUIRE(converted);
    CHECK(converted->x == Approx(95.0456).epsilon(1e-4));
    CHECK(converted->z == Approx(108.906).epsilon(1e-4));
    for (const char* wrong : {"", "1 2", "1 2 3 4", "a b c", "1 2 -3", "xyY 0.3 0 100", "1 nan 2"}) {
        CAPTURE(wrong);
        CHECK_FALSE(typed_xyz(wrong));
    }
}

TEST_CASE("files of a set are written all or none", "[unit]") {
    const TemporaryFolder folder;
    const auto a = folder.path() / "a.txt", b = folder.path() / "b.txt";
    write_file_set({{a, "one"}, {b, "two"}}, false);
    CHECK(text_of(a) == "one");
    CHECK_THROWS_AS(write_file_set({{folder.path() / "c.txt", "three"}, {b, "four"}}, false), InputError);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "c.txt"));
    CHECK(text_of(b) == "two");
    write_file_set({{a, "five"}, {b, "six"}}, true);
    CHECK(text_of(b) == "six");
    CHECK_THROWS_AS(write_file_set({{folder.path() / "no/c.txt", ""}}, true), InputError);
    // Nothing hidden is left behind.
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}
