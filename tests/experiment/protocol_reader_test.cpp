#include "experiment/protocol/protocol_reader.h"

#include <unistd.h>

#include <catch2/catch.hpp>

#include "experiment/protocol_fixtures.h"
#include "experiment/random.h"

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
    CHECK_FALSE(read.protocol->view.vertical_fov_deg);
    CHECK(read.protocol->animation.frame_count == 61);
    CHECK(read.protocol->title == "minimal");
    CHECK(read.protocol->sculptures.at(0).title == "a");
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
[[sculpture]]
id = "p"
mesh = "scans/p.ply"
up = "-y"
scale = 2
[sculpture.head]
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
stimuli = "once-per-sculpture"
[[frames]]
sculpture = "p"
material = "coat"
files = "f/x_####.exr"
first_number = 1
encoding = "srgb"
[schedule]
observers = 5
)");
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    CHECK(read.protocol->view.camera_position == glm::dvec3(0.0, -4.5, 1.0));
    CHECK(read.protocol->animation.playback == Playback::ping_pong);
    CHECK(read.protocol->animation.amplitude.value == 12.5);
    const SculptureSettings& sculpture = read.protocol->sculptures.at(0);
    CHECK(sculpture.mesh == "scans/p.ply");
    CHECK(sculpture.up == "-y");
    CHECK(sculpture.scale == 2.0);
    CHECK(sculpture.head_spheres.at(0) == std::array{0.015, 0.82, -0.05, 0.215});
    CHECK(sculpture.head_spheres.at(1) == std::array{1.0, 2.0, 3.0, 4.0});
    CHECK(sculpture.head_planes == std::vector{std::array{0.0, 0.63, -0.05, 0.0, 1.0, 0.0}});
    CHECK(read.protocol->materials.at(0).kind == MaterialKind::coated_conductor);
    CHECK(read.protocol->materials.at(0).coat_absorbance == std::array{0.0, 0.1, 0.75});
    CHECK(read.protocol->tasks.at(0).stimuli == TaskCoverage::once_per_sculpture);
    CHECK(read.protocol->frames.at(0).encoding == FrameEncoding::srgb);
    CHECK(frame_file(read.protocol->frames.at(0), {7}) == "f/x_0008.exr");
    CHECK(find_frames(*read.protocol, 0, 0) == &read.protocol->frames.at(0));
}

TEST_CASE("paths count from the protocol's folder", "[unit]") {
    Diagnostics diagnostics;
    const std::string text = std::string(minimal_protocol) + "[[sculpture]]\nid = \"m\"\nmesh = \"m.ply\"\n"
                                                             "[light]\nprobe = \"/lab/square.exr\"\n";
    const auto protocol = read_protocol_text(text, "/lab/study/p.toml", shipped_names, diagnostics);
    REQUIRE(protocol);
    CHECK(protocol->sculptures.at(1).mesh == "/lab/study/m.ply");
    CHECK(protocol->sculptures.at(0).mesh.empty());
    CHECK(protocol->light.probe == "/lab/square.exr");
    CHECK(protocol->text == text);
    CHECK(protocol->file == "/lab/study/p.toml");
}

TEST_CASE("a protocol with many errors reports all of them with their places", "[unit]") {
    Diagnostics diagnostics;
    const auto file = source_path("tests/data/protocols/many_errors.toml");
    CHECK_FALSE(read_protocol(file, shipped_names, diagnostics));
    std::vector<std::pair<Place, std::string>> found;
    for (const Finding& finding : diagnostics.findings())
        found.emplace_back(finding.place, finding.message);
    const std::string folder = file.parent_path().string() + "/";
    const std::vector<std::pair<Place, std::string>> expected{
        {{3, 8}, "name: \"many errors\" cannot be used in file names"},
        {{6, 14},
         "a refresh rate of 100 Hz is no whole multiple of the frame rate of 30 Hz: frames would be lit "
         "for unequal times"},
        {{7, 1}, "unknown key \"viewing_distnace_mm\" in [display]"},
        {{8, 9}, "gamma: expected a number, found a text"},
        {{9, 10}, "output: unknown value \"color+\""},
        {{11, 2}, "unknown section [trackr]"},
        {{15, 12}, "the image is 2048 px wide, the screen only 1920 px"},
        {{16, 13}, "height_px: expected a whole number of px, found a number"},
        {{17, 19}, "camera_position: expected 3 numbers, found 2"},
        {{20, 9}, "there is no file " + folder + "no_such_probe.exr"},
        {{23, 14}, "8.01 s hold 240.3 frames at 30 Hz, which is no whole number"},
        {{24, 17}, "amplitude_deg: 250 is out of range, which is 0 … 180 deg"},
        {{27, 8}, "seed: -1 is out of range, which is at least 0"},
        {{31, 18}, "the response screen ends after 2 s, before its least time of 5 s"},
        {{32, 13}, "text of grey 0.01 cannot be seen on a background of 0"},
        {{36, 8}, "a sculpture is either \"shipped\" or a \"mesh\", not both"},
        {{36, 8}, "there is no file " + folder + "no_such_mesh.ply"},
        {{40, 6}, "id \"hermes\" is taken already"},
        {{41, 11}, "overt has no sculpture \"mouse\""},
        {{43, 1}, "sculpture \"penelope\" has neither \"shipped\" nor \"mesh\""},
        {{49, 13}, "roughness: 1.3 is out of range, which is 0.001 … 1"},
        {{51, 1}, "[[material]] has no \"kind\""},
        {{53, 9}, "metal: unknown value \"Fe\""},
        {{55, 1}, "[[task]] has no \"id\""},
        {{56, 12}, "question: expected a text, found a whole number"},
        {{59, 13}, "there is no [[sculpture]] \"hermse\""},
        {{61, 9}, "the path needs one group of # for the digits of the frame number"},
        {{66, 9}, "61 of 61 frames are missing"}};
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
        CAPTURE(i);
        CHECK(found[i].second == expected[i].second);
        CHECK(found[i].first.line == expected[i].first.line);
        CHECK(found[i].first.column == expected[i].first.column);
    }
    CHECK(found.size() == expected.size());
}

TEST_CASE("hints name the nearest rates, names and lines", "[unit]") {
    Diagnostics diagnostics;
    read_protocol(source_path("tests/data/protocols/many_errors.toml"), shipped_names, diagnostics);
    std::map<int, std::string> hints;
    for (const Finding& finding : diagnostics.findings())
        hints.try_emplace(finding.place.line, finding.hint);
    CHECK(hints[6] == "90 Hz or 120 Hz would do");
    CHECK(hints[7] == "did you mean \"viewing_distance_mm\"?");
    CHECK(hints[9] == "did you mean \"color++\"?");
    CHECK(hints[11] == "did you mean \"tracker\"?");
    CHECK(hints[16] == "write 512, without the point");
    CHECK(hints[23] == "8 s are 240 frames");
    CHECK(hints[40] == "by the [[sculpture]] in line 35");
    CHECK(hints[41] == "did you mean \"muse\"?");
    CHECK(hints[59] == "did you mean \"hermes\"?");
}

TEST_CASE("syntax errors of several lines, double keys and unknown keys are found together", "[unit]") {
    const ReadText read(minimal_protocol, "[display]\n"
                                          "width_px = = 3\n"
                                          "gamma = 1\n"
                                          "gamma = 2\n"
                                          "heigth_px = 1080\n"
                                          "output = \"color++\n"
                                          "[tracker]\n"
                                          "eye = \"middle\"\n");
    CHECK_FALSE(read.protocol);
    const Lines lines = read.lines();
    REQUIRE(lines.size() == 5);
    CHECK_THAT(lines[0], Catch::StartsWith("13:12: "));
    CHECK_THAT(lines[1], Catch::StartsWith("15:9: cannot redefine existing"));
    CHECK(lines[2] == "16:1: unknown key \"heigth_px\" in [display]");
    CHECK_THAT(lines[3], Catch::StartsWith("17:"));
    CHECK(lines[4] == "19:7: eye: unknown value \"middle\"");
}

TEST_CASE("lines lost to syntax errors raise no complaints about what they may have held", "[unit]") {
    const ReadText read("[protocol]\nname = minimal\n[[task]]\nid = \"a\"\nquestion = Look\n");
    const Lines lines = read.lines();
    REQUIRE(lines.size() == 2);
    CHECK_THAT(lines[0], Catch::StartsWith("2:8: "));
    CHECK_THAT(lines[1], Catch::StartsWith("5:"));
}

TEST_CASE("headings without a name are found, whatever stands in their place", "[unit]") {
    for (const char* heading : {"[=]\n", "[.a]\n", "[[{]]\n", "  [[ é ]]\n", "[]\n"}) {
        CAPTURE(heading);
        const ReadText read(minimal_protocol, heading);
        REQUIRE(read.diagnostics.findings().size() == 1);
        CHECK(read.diagnostics.findings()[0].place.line == 12);
    }
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
    CHECK(ReadText(minimal_protocol, "[frames]\nsculpture = \"a\"\n").lines() ==
          Lines{"12:1: frames: expected a list of sections"});
}

TEST_CASE("a key in the wrong section is sent home", "[unit]") {
    const ReadText read(minimal_protocol, "[tracker]\nrefresh_hz = 120\n");
    REQUIRE(read.diagnostics.findings().size() == 1);
    CHECK(read.diagnostics.findings()[0].hint == "\"refresh_hz\" belongs to [display]");
}

TEST_CASE("an empty file is told what it needs", "[unit]") {
    CHECK(ReadText("").lines() == Lines{"1:1: [protocol] has no \"name\"", "1:1: there is no [[task]]",
                                        "1:1: there is no [[sculpture]]", "1:1: there is no [[material]]"});
}

TEST_CASE("a finding between two keys points at the one that is written", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[animation]\nframe_rate_hz = 50\nduration_s = 2\n").lines() ==
          Lines{"13:17: a refresh rate of 120 Hz is no whole multiple of the frame rate of 50 Hz: frames "
                "would be "
                "lit for unequal times"});
    // A value found wrong by itself is not compared with others.
    CHECK(ReadText(minimal_protocol, "[display]\nrefresh_hz = \"x\"\n[animation]\nframe_rate_hz = 50\n")
              .lines() == Lines{"13:14: refresh_hz: expected a number of Hz, found a text"});
}

TEST_CASE("head shapes that cannot be are found where they stand", "[unit]") {
    const std::string mesh = "[[sculpture]]\nid = \"m\"\nmesh = \"m.ply\"\n"; // lines 12 to 14
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3, 0]] }\n").lines() ==
          Lines{"15:21: spheres: a sphere's radius of 0 is not above 0"});
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3]] }\n").lines() ==
          Lines{"15:21: spheres: expected 4 numbers, found 3"});
    CHECK(ReadText(minimal_protocol, mesh + "head = { spheres = [[1, 2, 3, 4]], planes = [[0, 1]] }\n")
              .lines() ==
          Lines{"15:47: planes: expected a list of planes [[x, y, z], [nx, ny, nz]], found a whole number"});
    CHECK(ReadText(minimal_protocol, mesh + "head = 3\n").lines() ==
          Lines{"15:8: head: expected a table, found a whole number"});
}

TEST_CASE("keys without effect are warned of, and the protocol is taken", "[unit]") {
    const ReadText read(minimal_protocol, "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\nroughness = 0.2\n"
                                          "[[sculpture]]\nid = \"b\"\nshipped = \"runner\"\nup = \"y\"\n");
    CHECK(read.lines() == Lines{"15:13: \"roughness\" has no effect on a material of kind \"diffuse\"",
                                "19:6: \"up\" has no effect without \"mesh\""});
    CHECK(read.protocol);
    CHECK_FALSE(read.diagnostics.has_errors());
}

TEST_CASE("numbers of observers that leave cells unequal are warned of", "[unit]") {
    const std::string more =
        "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n[[task]]\nid = \"age\"\n"
        "question = \"?\"\nstimuli = \"once-per-sculpture\"\n[schedule]\nobservers = 7\n";
    const ReadText read(minimal_protocol, more);
    REQUIRE(read.protocol);
    REQUIRE(read.lines().size() == 1);
    CHECK(read.diagnostics.findings()[0].place == Place{20, 13});
    CHECK(read.diagnostics.findings()[0].hint == "6 or 8 observers would");
}

TEST_CASE("limits that no order keeps to are errors of the protocol", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[sculpture]]\nid = \"b\"\nshipped = \"runner\"\n[[material]]\n"
                        "id = \"x\"\nkind = \"diffuse\"\n[[task]]\nid = \"age\"\nquestion = \"?\"\n"
                        "stimuli = \"once-per-sculpture\"\n[schedule]\nmax_task_run = 1\n");
    CHECK(read.lines() ==
          Lines{"23:16: no order keeps to runs of 1 with the same task: one task has 4 of the 6 trials"});
    CHECK(read.diagnostics.findings()[0].hint == "allow runs of 2 at least, or 0 for no limit");
}

TEST_CASE("text that cannot be read and pictures that do not fit are errors", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[screens]\ntext_height_deg = 0.05\n").lines() ==
          Lines{"13:19: text of 0.05 deg is 4.2 px high: too small to be read"});
    CHECK(ReadText(minimal_protocol, "[screens]\ntext_height_deg = 2\n").lines() ==
          Lines{"13:19: text of 2 deg is 168 px high: too large for a screen of 1080 rows"});
    CHECK(ReadText(minimal_protocol, "[view]\nheight_px = 1200\n").lines() ==
          Lines{"13:13: the image is 1200 px high, the screen only 1080 px"});
    CHECK(ReadText(minimal_protocol, "[view]\nwidth_px = 511\n").lines() ==
          Lines{"13:12: color++ joins pixels in pairs: the width has to be even"});
}

TEST_CASE("more than 254 entries of a list are refused at the first too many", "[unit]") {
    std::string tasks;
    for (int i = 0; i < 300; ++i)
        tasks += fmt::format("[[task]]\nid = \"t{}\"\nquestion = \"?\"\n", i);
    // Task 0 stands in line 9; entry 254 is t253.
    CHECK(ReadText(minimal_protocol, tasks).lines() ==
          Lines{fmt::format("{}:1: more than 254 entries of [[task]]", 12 + 3 * 253)});
}

TEST_CASE("a file that cannot be read is named, without a place", "[unit]") {
    Diagnostics diagnostics;
    CHECK_FALSE(read_protocol("no/such/file.toml", shipped_names, diagnostics));
    CHECK_FALSE(read_protocol(OVERT_SOURCE_DIR, shipped_names, diagnostics));
    REQUIRE(diagnostics.error_count() == 2);
    CHECK_THAT(diagnostics.print(),
               Catch::Contains("no/such/file.toml: error: cannot be read: No such file") &&
                   Catch::Contains(": error: this is a folder"));
}

TEST_CASE("files that are there are found, and those of a sequence that are not are counted", "[unit]") {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("overt_protocol_test_{}", ::getpid());
    std::filesystem::create_directories(folder / "frames");
    for (const char* name : {"m.ply", "p.toml", "frames/g_09.exr", "frames/g_11.exr", "frames/g_12.exr"})
        std::ofstream(folder / name) << "\n";
    const std::string text = std::string(minimal_protocol) +
                             "[[sculpture]]\nid = \"m\"\nmesh = \"m.ply\"\n[[frames]]\nsculpture = \"m\"\n"
                             "material = \"gold\"\nfiles = \"frames/g_##.exr\"\nfirst_number = 9\n"
                             "[animation]\nframe_count = 5\n";
    std::ofstream(folder / "p.toml") << text;
    Diagnostics diagnostics;
    CHECK_FALSE(read_protocol(folder / "p.toml", shipped_names, diagnostics));
    REQUIRE(diagnostics.findings().size() == 1);
    CHECK(diagnostics.findings()[0].place == Place{18, 9});
    CHECK(diagnostics.findings()[0].message == "2 of 5 frames are missing");
    CHECK(diagnostics.findings()[0].hint == "the first is " + (folder / "frames/g_10.exr").string());
    for (const char* name : {"frames/g_10.exr", "frames/g_13.exr"})
        std::ofstream(folder / name) << "\n";
    Diagnostics complete;
    CHECK(read_protocol(folder / "p.toml", shipped_names, complete));
    CHECK(complete.print() == "");
    std::filesystem::remove_all(folder);
}

TEST_CASE("the protocols shown in docs/laser_scans.md are sound", "[unit]") {
    const std::string page = text_of_file(source_path("docs/laser_scans.md"));
    const auto block_after = [&](std::size_t from) {
        const std::size_t begin = page.find("```toml\n", from) + 8;
        return page.substr(begin, page.find("```", begin) - begin);
    };
    const std::string whole = block_after(0);
    const ReadText read(whole);
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    CHECK(read.protocol->sculptures.size() == 3);
    CHECK(read.protocol->sculptures.at(1).head_planes.size() == 1);
    const ReadText with_frames(whole, block_after(page.find("## Frames rendered elsewhere")));
    CHECK(with_frames.diagnostics.print() == "");
    REQUIRE(with_frames.protocol);
    CHECK(frame_file(with_frames.protocol->frames.at(0), {1}) == "frames/hermes_smooth_0002.exr");
}

TEST_CASE("the protocols that overt brings are sound", "[unit]") {
    for (const char* file : {"protocols/overt_2019.toml", "protocols/quick_look.toml"}) {
        Diagnostics diagnostics;
        CHECK(read_protocol(source_path(file), shipped_names, diagnostics));
        CHECK(diagnostics.print() == "");
    }
    const Protocol paper = paper_protocol();
    CHECK(paper.tasks.size() == 6);
    CHECK(paper.sculptures.size() == 3);
    CHECK(paper.materials.size() == 3);
    CHECK(paper.schedule.observers == 12);
}

TEST_CASE("no change of its bytes makes reading a protocol fail in any way but by findings", "[unit]") {
    const std::string sound = text_of_file(source_path("protocols/overt_2019.toml"));
    RandomStream random(20190728, "changed bytes");
    int refused = 0;
    for (int round = 0; round < 500; ++round) {
        std::string text = sound;
        for (int changes = 1 + static_cast<int>(random.below(8)); changes > 0; --changes) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
            switch (random.below(5)) {
            case 0:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.erase(at, random.below(30));
                break;
            case 2:
                text.insert(
                    at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), random.below(60)));
                break;
            case 3:
                text.insert(at, std::array{"é", "\u2003", "😀", "\\\n ", "\"\"\""}[random.below(5)]);
                break;
            default:
                text[at] = "[]{}=\"'#.,\n0-"[random.below(13)];
            }
        }
        const ReadText read(text);
        CHECK(read.protocol.has_value() == !read.diagnostics.has_errors());
        CHECK_NOTHROW(read.diagnostics.print());
        const int lines = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
        for (const Finding& finding : read.diagnostics.findings()) {
            CHECK(finding.place.line >= 1);
            CHECK(finding.place.line <= lines);
        }
        refused += read.protocol ? 0 : 1;
    }
    CHECK(refused > 250); // the changes do reach what is checked
    CHECK(refused < 500);
}
