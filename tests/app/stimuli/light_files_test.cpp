/// The small pictures of light that a session keeps, against frames exported for other programs.
#include <filesystem>
#include <numeric>
#include <set>

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/animation.h"
#include "experiment/maps/light_pictures.h"
#include "render/stimulus/given_maps.h"
#include "tests/app/stimuli/traced_experiment.h"
#include "tests/support/motion_of.h"

namespace fs = std::filesystem;
using namespace overt;
using namespace overt::test;

TEST_CASE("a session keeps the light of its stimuli, as their frames have it", "[session]") {
    // Of 40 x 48 pixels, so that a square is one of them.
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const fs::path out = experiment.folder().path() / "out";
    REQUIRE(bake(experiment, {"--quality", "draft", "--stimulus", "bust/smooth", "--out", out.string()})
                .exit_code == 0);
    REQUIRE(bake(experiment, {"--quality", "draft"}).exit_code == 0);
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    for (const char* const stimulus : {"bust_smooth", "bust_matt", "tall_smooth", "tall_matt"})
        CHECK(fs::exists(experiment.session() / "stimuli" / (std::string(stimulus) + "_light.exr")));
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);

    const LightPictures light =
        read_light_pictures(experiment.session() / "stimuli/bust_smooth_light.exr", {40, 48}, poses);
    REQUIRE(light.square_px == 1);
    const PoseTable table = distinct_poses(motion_of(7, 6.0, 8.0));
    REQUIRE(table.angles.size() == static_cast<std::size_t>(poses));
    int bright = 0, clipped = 0;
    for (int pose = 0; pose < poses; ++pose) {
        const fs::path file =
            out / fmt::format("bust_smooth/frame_{:04}.exr", first_frame_of(table, {pose}).value);
        const PictureHeader header = header_of(file);
        const auto at = [&](const char* name) { return static_cast<std::size_t>(header.channel(name)); };
        const std::vector<float> values = values_in(file);
        for (std::size_t i = 0; i < light.squares(); ++i) {
            const float* const pixel = &values[4 * i];
            const std::size_t square = static_cast<std::size_t>(pose) * light.squares() + i;
            // The shares of a display with the primaries of sRGB, which the protocol leaves as they are.
            // No channel is shown darker than nothing or brighter than the display's white.
            const auto shown = [&](const char* name) {
                return std::clamp(static_cast<double>(pixel[at(name)]), 0.0, 1.0);
            };
            const double luminance = 0.2126 * shown("R") + 0.7152 * shown("G") + 0.0722 * shown("B");
            clipped += shown("R") == 1.0;
            const auto covered = static_cast<double>(light.coverage[square]);
            CHECK(covered == Approx(static_cast<double>(pixel[at("A")])).margin(0.001));
            CHECK(covered * static_cast<double>(light.luminance[square]) ==
                  Approx(luminance).epsilon(0.002).margin(2e-4));
            bright += luminance > 0.05;
        }
    }
    CHECK(bright > 300);
    CHECK(clipped > 0);
}

TEST_CASE(
    "of ready-made frames without alpha no light is kept, for what they show of the object is not known",
    "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const fs::path folder = experiment.folder().path();
    REQUIRE(bake(experiment, {"--quality", "draft"}).exit_code == 0);
    for (const auto& [name, more] : {std::pair<std::string, std::string>{"png", "--png16"}, {"exr", ""}}) {
        std::vector<std::string> arguments{"--quality",   "draft", "--stimulus",
                                           "bust/smooth", "--out", (folder / name).string()};
        if (!more.empty())
            arguments.push_back(more);
        REQUIRE(bake(experiment, arguments).exit_code == 0);
        experiment.folder().file(
            "small.toml", traced_protocol() + "[[frames]]\nobject = \"bust\"\nmaterial = \"smooth\"\n" +
                              "files = \"" + name + "/bust_smooth/frame_####." + name + "\"\n");
        const ProgramRun run = experiment.run({"--trials", "1", "--observer", name + "01"});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        const fs::path stimuli = experiment.session(1, name + "01") / "stimuli";
        CHECK(fs::exists(stimuli / "bust_smooth_light.exr") == (name == "exr"));
        CHECK(fs::exists(stimuli / "bust_matt_light.exr"));
        experiment.folder().file("small.toml", traced_protocol());
    }
}

TEST_CASE("the first frames that a session keeps are those of its own light, whatever the cache has",
          "[session]") {
    const SmallExperiment experiment(Cache::own);
    const auto first_frames = [&](const std::string& protocol, int session) {
        experiment.folder().file("small.toml", protocol);
        REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
        std::vector<std::vector<float>> pictures;
        for (const char* const stimulus : {"bust_smooth", "bust_matt", "tall_smooth", "tall_matt"})
            pictures.push_back(
                values_in(experiment.session(session) / "stimuli" / (std::string(stimulus) + ".png")));
        return pictures;
    };
    const std::string other = with(small_protocol, "[schedule]\n", "[light]\nexposure = 0.5\n[schedule]\n");
    const auto plain = first_frames(std::string(small_protocol), 1), dark = first_frames(other, 2),
               again = first_frames(std::string(small_protocol), 3);
    CHECK(plain == again);
    const auto sum = [](const std::vector<float>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    for (std::size_t stimulus = 0; stimulus < plain.size(); ++stimulus)
        CHECK(sum(dark[stimulus]) < 0.97 * sum(plain[stimulus])); // most of the picture is background
    // Each is that of its own stimulus.
    CHECK(std::set(plain.begin(), plain.end()).size() == 4);
}
