#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/protocol/protocol.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using test::ReadText;
using Lines = std::vector<std::string>;

namespace {

/// A protocol whose one object is known by maps; what a test adds begins in line 17.
constexpr std::string_view with_maps = R"([protocol]
name = "maps"
[[material]]
id = "gold"
kind = "diffuse"
[[task]]
id = "free"
question = "Look."
[[frames]]
object = "a"
material = "gold"
files = "frames/####.png"
[[object]]
id = "a"
lut = "maps/frame_####.png"
lut_first_number = 1
)";

} // namespace

TEST_CASE("maps stand instead of a mesh, numbered like frames", "[unit]") {
    const ReadText read(with_maps, "lut_scale = 65536\nlut_min = [-1, -2, -3]\nlut_max = [1, 2, 3]\n"
                                   "head = { spheres = [[0, 0, 2, 1]] }\n");
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    const ObjectSettings& object = read.protocol->objects[0];
    CHECK(lut_file(object, {14}) == "maps/frame_0015.png");
    CHECK(object.lut_scale == 65536);
    CHECK(object.lut_min == glm::dvec3(-1, -2, -3));
    CHECK(object.lut_max == glm::dvec3(1, 2, 3));
}

TEST_CASE("what contradicts ready-made maps is found at its place", "[unit]") {
    CHECK(ReadText(with_maps, "mesh = \"a.ply\"\n").lines() ==
          Lines{"15:7: \"lut\" stands instead of \"shipped\" or \"mesh\", not beside it"});
    CHECK(ReadText(with_maps, "lut_min = [0, 0, 0]\n").lines() ==
          Lines{"17:11: a box needs both \"lut_min\" and \"lut_max\""});
    CHECK(ReadText(with_maps, "lut_min = [0, 5, 0]\nlut_max = [1, 4, 1]\n").lines() ==
          Lines{"17:11: a coordinate of \"lut_min\" is larger than that of \"lut_max\""});
    CHECK(ReadText(with_maps, "lut_scale = 255\n").diagnostics.has_errors());
    CHECK(ReadText(with_maps, "up = \"y\"\n").lines() ==
          Lines{"17:6: \"up\" has no effect without \"mesh\""});
    const ReadText second(with_maps, "[[material]]\nid = \"silver\"\nkind = \"diffuse\"\n");
    CHECK(second.lines() == Lines{"15:7: object \"a\" has maps, but not [[frames]] for every material"});
    CHECK(ReadText(test::minimal_protocol, "[[object]]\nid = \"b\"\nshipped = \"muse\"\nlut_scale = 65535\n")
              .lines() == Lines{"15:13: \"lut_scale\" has no effect without \"lut\""});
}

TEST_CASE("a path of maps without a group of # is an error", "[unit]") {
    std::string text(with_maps);
    text.replace(text.find("frame_####"), 10, "frame");
    CHECK(ReadText(text).lines() ==
          Lines{"15:7: the path needs one group of # for the digits of the frame number"});
}

TEST_CASE("missing maps are counted, and the first is named", "[unit]") {
    const test::TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "maps");
    std::filesystem::create_directories(folder.path() / "frames");
    for (int frame = 0; frame < 61; ++frame) {
        const std::ofstream picture(folder.path() / fmt::format("frames/{:04}.png", frame));
        if (frame % 10 != 3)
            const std::ofstream map(folder.path() / fmt::format("maps/frame_{:04}.png", frame + 1));
    }
    std::ofstream(folder.path() / "p.toml") << with_maps;
    Diagnostics diagnostics;
    CHECK_FALSE(read_protocol(folder.path() / "p.toml", test::shipped_names, diagnostics));
    const std::string findings = diagnostics.print();
    CHECK_THAT(findings, Catch::Contains("6 of 61 maps are missing") && Catch::Contains("frame_0004.png"));
}
