#include "experiment/checks/checked_protocol.h"

#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

TEST_CASE("keys left out have their defaults, and keys written their values", "[unit]") {
    const ReadText read(minimal_protocol, "[display]\nrefresh_hz = 60\nviewing_distance_mm = 612.5\n"
                                          "output = \"mono++\"\n[schedule]\nseed = 9007199254740993\n");
    REQUIRE(read.protocol);
    CHECK(read.lines().empty());
    CHECK(read.protocol->display.refresh_hz == 60.0);
    CHECK(read.protocol->display.viewing_distance_mm == 612.5);
    CHECK(read.protocol->display.output == OutputMode::mono_plus_plus);
    CHECK(read.protocol->display.width_px == DisplaySettings{}.width_px);
    CHECK(read.protocol->schedule.seed == 9007199254740993ull);
    CHECK_FALSE(read.protocol->views.front().vertical_fov_deg);
    CHECK(read.protocol->motions.front().frame_count == 61);
    CHECK(read.protocol->title == "minimal");
    CHECK(read.protocol->objects.at(0).title == "a");
}

TEST_CASE("lists, points and head shapes arrive number by number", "[unit]") {
    const ReadText read(R"([protocol]
name = "shapes"
title = "Shapes"
[view]
camera_position = [0, -4.5, 1]
[animation]
playback = "ping-pong"
amplitude_deg = 12.5
[[object]]
id = "p"
mesh = "scans/p.ply"
up = "-y"
scale = 2
[object.head]
spheres = [[0.015, 0.82, -0.05, 0.215], [1, 2, 3, 4]]
planes = [[[0, 0.63, -0.05], [0, 1, 0]]]
[[material]]
id = "coat"
kind = "coated-conductor"
metal = "Ag"
coat_absorbance = [0, 0.1, 0.75]
[[task]]
id = "age"
question = "How old?"
stimuli = "once-per-object"
[[frames]]
object = "p"
material = "coat"
files = "f/x_####.exr"
first_number = 1
encoding = "srgb"
[schedule]
observers = 5
)");
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    CHECK(read.protocol->views.front().camera_position == glm::dvec3(0.0, -4.5, 1.0));
    CHECK(read.protocol->motions.front().playback == Playback::ping_pong);
    CHECK(read.protocol->motions.front().amplitude.value == 12.5);
    const ObjectSettings& object = read.protocol->objects.at(0);
    CHECK(object.mesh == "scans/p.ply");
    CHECK(object.up == "-y");
    CHECK(object.scale == 2.0);
    CHECK(object.areas.at(0).spheres.at(0) == std::array{0.015, 0.82, -0.05, 0.215});
    CHECK(object.areas.at(0).spheres.at(1) == std::array{1.0, 2.0, 3.0, 4.0});
    CHECK(object.areas.at(0).planes == std::vector{std::array{0.0, 0.63, -0.05, 0.0, 1.0, 0.0}});
    CHECK(read.protocol->materials.at(0).kind == MaterialKind::coated_conductor);
    CHECK(read.protocol->materials.at(0).coat_absorbance == std::array{0.0, 0.1, 0.75});
    CHECK(read.protocol->tasks.at(0).stimuli == TaskCoverage::once_per_object);
    CHECK(read.protocol->frames.at(0).encoding == FrameEncoding::srgb);
    CHECK(frame_file(read.protocol->frames.at(0), {7}) == "f/x_0008.exr");
    CHECK(find_frames(*read.protocol, {0, 0}) == &read.protocol->frames.at(0));
}

TEST_CASE("paths count from the protocol's folder", "[unit]") {
    Diagnostics diagnostics;
    const std::string text = std::string(minimal_protocol) + "[[object]]\nid = \"m\"\nmesh = \"m.ply\"\n"
                                                             "[light]\nprobe = \"/lab/square.exr\"\n";
    const auto protocol = read_protocol_text(text, "/lab/study/p.toml", shipped_names, diagnostics);
    REQUIRE(protocol);
    CHECK(protocol->objects.at(1).mesh == "/lab/study/m.ply");
    CHECK(protocol->objects.at(0).mesh.empty());
    CHECK(protocol->lights.front().probe == "/lab/square.exr");
    CHECK(protocol->text == text);
    CHECK(protocol->file == "/lab/study/p.toml");
}

TEST_CASE("a whole number may stand for a number, never a number for a whole one", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = 60\n").protocol);
    CHECK(ReadText(minimal_protocol, "[display]\nheight_px = 1080.0\n").lines() ==
          Lines{"13:13: height_px: expected a whole number of px, found a number"});
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = true\n").lines() ==
          Lines{"13:14: refresh_hz: expected a number of Hz, found a truth value"});
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = \"120\"\n").lines() ==
          Lines{"13:14: refresh_hz: expected a number of Hz, found a text"});
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = 2019-07-28\n").lines() ==
          Lines{"13:14: refresh_hz: expected a number of Hz, found a date or time"});
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = nan\n").lines() ==
          Lines{"13:14: refresh_hz: nan is no usable number"});
    CHECK(ReadText(minimal_protocol, "[display]\nlatency_ms = inf\n").lines() ==
          Lines{"13:14: latency_ms: inf is no usable number"});
    CHECK(ReadText(minimal_protocol, "[display]\nwidth_px = 99999999999\n").lines() ==
          Lines{"13:12: width_px: 99999999999 is out of range, which is 16 … 16384 px"});
}

TEST_CASE("sections and lists are told apart", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[[display]]\ngamma = 2.2\n").lines() ==
          Lines{"12:1: display: expected a section, found a list"});
    CHECK(ReadText("display = 3\n", minimal_protocol).lines() ==
          Lines{"1:11: display: expected a section, found a whole number"});
    CHECK(ReadText("gamma = 2.2\n", minimal_protocol).lines() ==
          Lines{"1:1: key \"gamma\" stands outside all sections"});
    CHECK(ReadText(minimal_protocol, "[frames]\nobject = \"a\"\n").lines() ==
          Lines{"12:1: frames: expected a list of sections"});
}

TEST_CASE("a key in the wrong section is sent home", "[unit]") {
    const ReadText read(minimal_protocol, "[tracker]\nrefresh_hz = 120\n");
    REQUIRE(read.diagnostics.findings().size() == 1);
    CHECK(read.diagnostics.findings()[0].hint == "\"refresh_hz\" belongs to [display]");
}

TEST_CASE("an empty file is told what it needs", "[unit]") {
    CHECK(ReadText("").lines() == Lines{"1:1: [protocol] has no \"name\"", "1:1: there is no [[task]]",
                                        "1:1: there is no [[object]]", "1:1: there is no [[material]]"});
}

TEST_CASE("a single sphere or plane needs no list around it", "[unit]") {
    const std::string mesh = "[[object]]\nid = \"m\"\nmesh = \"m.ply\"\n";
    const ReadText one(minimal_protocol,
                       mesh + "head = { spheres = [1, 2, 3, 4], planes = [[1, 2, 3], [0, 0, 1]] }\n");
    const ReadText list(minimal_protocol,
                        mesh + "head = { spheres = [[1, 2, 3, 4]], planes = [[[1, 2, 3], [0, 0, 1]]] }\n");
    REQUIRE((one.protocol && list.protocol));
    const AreaSettings& shape = one.protocol->objects.back().areas.at(0);
    CHECK(shape.spheres == list.protocol->objects.back().areas.at(0).spheres);
    CHECK(shape.planes == list.protocol->objects.back().areas.at(0).planes);
    CHECK(shape.planes.size() == 1);
}

TEST_CASE("head shapes that cannot be are found where they stand", "[unit]") {
    const std::string mesh = "[[object]]\nid = \"m\"\nmesh = \"m.ply\"\n"; // lines 12 to 14
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3, 0]] }\n").lines() ==
          Lines{"15:21: spheres: a sphere's radius of 0 is not above 0"});
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3]] }\n").lines() ==
          Lines{"15:21: spheres: expected 4 numbers, found 3"});
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3, 4]], planes = [[0, 1]] }\n")
              .lines() ==
          Lines{"15:45: planes: expected a point and a direction, [[x, y, z], [nx, ny, nz]]"});
    CHECK(ReadText(minimal_protocol, mesh + "head = 3\n").lines() ==
          Lines{"15:8: head: expected a table, found a whole number"});
}
