/// The module that reads and writes pictures is loaded when it is needed, and missed by name.
#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a program without its module for pictures does what needs none, and names it where one is needed",
          "[session]") {
    const SmallExperiment experiment;
    const TemporaryFolder alone;
    const std::filesystem::path program = alone.path() / "bin/overt", said = alone.path() / "said";
    std::filesystem::create_directories(program.parent_path());
    std::filesystem::copy_file(OVERT_PROGRAM, program);
    const auto run = [&](const std::string& arguments) {
        const std::string command = "OVERT_CACHE=" + quoted_for_shell((alone.path() / "cache").string()) +
                                    " " + quoted_for_shell(program.string()) + " " + arguments + " >" +
                                    quoted_for_shell(said.string()) + " 2>&1";
        return std::system(command.c_str());
    };
    CHECK(run("--version") == 0);
    // Pictures for people need none, and 16-bit PNG files do.
    const std::string picture = (alone.path() / "frame.png").string(),
                      maps = (alone.path() / "maps").string();
    CHECK(run("play " + quoted_for_shell(experiment.protocol().string()) +
              " --stimulus tall/matt --frame 0 --context osmesa --picture " + quoted_for_shell(picture)) ==
          0);
    CHECK(std::filesystem::exists(picture));
    CHECK(run("lut " + quoted_for_shell(experiment.protocol().string()) +
              " --stimulus tall --frame 0 --context osmesa --format png16 --out " + quoted_for_shell(maps)) !=
          0);
    CHECK_THAT(text_of(said), Catch::Contains((alone.path() / "lib/overt/overt_pictures.so").string()) &&
                                  Catch::Contains("again"));
    CHECK_FALSE(std::filesystem::exists(maps + "/tall_frame_0000.png"));
}
