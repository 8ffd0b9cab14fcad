#include "experiment/checks/checked_protocol.h"

#include <map>

#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

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
        {{36, 8}, "an object is either \"shipped\" or a \"mesh\", not both"},
        {{36, 8}, "there is no file " + folder + "no_such_mesh.ply"},
        {{40, 6}, "id \"hermes\" is taken already"},
        {{41, 11}, "overt has no sculpture \"mouse\""},
        {{43, 1}, "object \"penelope\" has neither \"shipped\" nor \"mesh\""},
        {{49, 13}, "roughness: 1.3 is out of range, which is 0.001 … 1"},
        {{51, 1}, "[[material]] has no \"kind\""},
        {{53, 9}, "there is no metal \"Fe\""},
        {{56, 12}, "question: expected a text, found a whole number"},
        {{59, 10}, "there is no [[object]] \"hermse\""},
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
    CHECK(hints[6] == "90 Hz or 120 Hz would do; or frame_rate_hz = 33.3333 or 25");
    CHECK(hints[7] == "did you mean \"viewing_distance_mm\"?");
    CHECK(hints[9] == "did you mean \"color++\"?");
    CHECK(hints[11] == "did you mean \"tracker\"?");
    CHECK(hints[16] == "write 512, without the point");
    CHECK(hints[23] == "8 s are 240 frames");
    CHECK(hints[40] == "by the [[object]] in line 35");
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

TEST_CASE("a protocol in UTF-16 is told by one error, and one in UTF-8 with a mark before it is taken",
          "[unit]") {
    std::string utf16 = "\xff\xfe";
    for (const char character : std::string(minimal_protocol))
        (utf16 += character) += '\0';
    const ReadText read(utf16);
    CHECK(read.lines() == Lines{"1:1: the file is in UTF-16"});
    CHECK(read.diagnostics.findings().front().hint == "save it as UTF-8");
    CHECK(ReadText("\xef\xbb\xbf" + std::string(minimal_protocol)).protocol);
}

TEST_CASE("what is no TOML is told after twenty lines, however long it is", "[unit]") {
    std::string prose;
    for (int line = 0; line < 50000; ++line)
        prose += "no protocol\n";
    const ReadText read(prose);
    CHECK_FALSE(read.protocol);
    REQUIRE(read.lines().size() == 21);
    CHECK_THAT(read.lines().back(), Catch::StartsWith("20:"));
    CHECK_THAT(read.lines().back(), Catch::Contains("the rest was not looked at"));
}

TEST_CASE("a key of very many parts is refused rather than followed", "[unit]") {
    std::string key;
    for (int part = 0; part < 200000; ++part)
        key += "a.";
    CHECK(ReadText(minimal_protocol, key + "b = 1\n").lines() == Lines{"12:1: a key of more than 32 parts"});
    CHECK(ReadText(minimal_protocol, "[screens]\nresponse_text = \"Wait." + std::string(200, '.') +
                                         " www.a.b.c. 1.2.3. One. Two. Three.\"\n")
              .protocol);
}

TEST_CASE("other encodings are named", "[unit]") {
    std::string utf16, utf32 = {'\xff', '\xfe', '\0', '\0'};
    for (const char character : std::string(minimal_protocol)) {
        (utf16 += '\0') += character;
        ((((utf32 += character) += '\0') += '\0') += '\0');
    }
    CHECK(ReadText(utf16).lines() == Lines{"1:1: the file is in UTF-16"});
    CHECK(ReadText(utf32).lines() == Lines{"1:1: the file is in UTF-32"});
    const ReadText latin(minimal_protocol, "[screens]\nresponse_text = \"Caf\xe9\"\n");
    REQUIRE(latin.lines().size() == 1);
    CHECK(latin.diagnostics.findings()[0].place.line == 13);
    CHECK(latin.diagnostics.findings()[0].hint == "save the file as UTF-8");
}

TEST_CASE("the usual slips of TOML come with what mends them", "[unit]") {
    const std::pair<const char*, const char*> slips[] = {
        {"[display]\ngamma = 2,2\n", "numbers have a point"},
        {"[display]\ngamma = .5\n", "write a 0 before the point"},
        {"[display]\noutput = native-8bit\n", "a text stands between quotation marks: \"native-8bit\""},
        {"[display]\noutput = “mono++”\n", "straight quotation marks"},
        {"[display]\ngamma 2.2\n", "write the key, =, and its value"},
        {"[breaks]\nbetween_blocks = True\n", "small letters"},
        {"[screens]\nwelcome_text = \"Hello\nfarewell_text = \"Bye\"\n", "the text is not closed"},
        {"[display]\ngamma = 2\n[display]\n", "all keys of a section stand below one heading"},
        {"[display\ngamma = 2\n", "a section is [name]"}};
    for (const auto& [slip, remedy] : slips) {
        CAPTURE(slip);
        const ReadText read(minimal_protocol, slip);
        REQUIRE_FALSE(read.lines().empty());
        CHECK_THAT(read.diagnostics.findings()[0].hint, Catch::Contains(remedy));
    }
}

TEST_CASE("a key above all headings is told where it belongs", "[unit]") {
    const ReadText stray("gamma = 2.2\n", minimal_protocol);
    REQUIRE(stray.lines() == Lines{"1:1: key \"gamma\" stands outside all sections"});
    CHECK(stray.diagnostics.findings()[0].hint == "write it below the heading [display]");
}

TEST_CASE("a stimulus that the frame store cannot hold is an error before anyone sits down", "[unit]") {
    // 31 distinct poses of 1024 x 1024 pixels of 4 bytes. With room for 8 of them they come from disk.
    CHECK(ReadText(minimal_protocol, "[display]\nframe_store_mb = 131\n").protocol);
    CHECK(ReadText(minimal_protocol, "[display]\nframe_store_mb = 33.6\n").protocol);
    const ReadText small(minimal_protocol, "[display]\nframe_store_mb = 33.5\n");
    CHECK(small.lines() == Lines{"13:18: a stimulus takes 130 MB of the frame store, which may take 33.5"});
    CHECK_THAT(small.diagnostics.findings()[0].hint, Catch::StartsWith("write frame_store_mb = 131"));
    // Noise is added by the card, to pages of 8 bytes.
    const ReadText noise(minimal_protocol, "[display]\nframe_store_mb = 33.6\noutput = \"native-8bit\"\n"
                                           "gamma = 2\ndither = \"ordered\"\n");
    REQUIRE(noise.lines().size() == 1);
    CHECK_THAT(noise.lines()[0], Catch::StartsWith("13:18: a stimulus takes 260 MB"));
    // What the observer turns comes in no order that could be read ahead.
    const ReadText turned(minimal_protocol, "[display]\nframe_store_mb = 100\n[animation]\n"
                                            "kind = \"observer\"\n");
    REQUIRE_FALSE(turned.lines().empty());
    CHECK_THAT(turned.lines()[0], Catch::Contains("of the frame store, which may take 100"));
}

TEST_CASE("headings without a name are found, whatever stands in their place", "[unit]") {
    for (const char* heading : {"[=]\n", "[.a]\n", "[[{]]\n", "  [[ é ]]\n", "[]\n"}) {
        CAPTURE(heading);
        const ReadText read(minimal_protocol, heading);
        REQUIRE(read.diagnostics.findings().size() == 1);
        CHECK(read.diagnostics.findings()[0].place.line == 12);
    }
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

TEST_CASE("keys without effect are warned of, and the protocol is taken", "[unit]") {
    const ReadText read(minimal_protocol, "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\nroughness = 0.2\n"
                                          "[[object]]\nid = \"b\"\nshipped = \"runner\"\nup = \"y\"\n");
    CHECK(read.lines() == Lines{"15:13: \"roughness\" has no effect on a material of kind \"diffuse\"",
                                "19:6: \"up\" has no effect without \"mesh\""});
    CHECK(read.protocol);
    CHECK_FALSE(read.diagnostics.has_errors());
}

TEST_CASE("numbers of observers that leave cells unequal are warned of", "[unit]") {
    const std::string more = "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n[[task]]\nid = \"age\"\n"
                             "question = \"?\"\nstimuli = \"once-per-object\"\n[schedule]\nobservers = 7\n";
    const ReadText read(minimal_protocol, more);
    REQUIRE(read.protocol);
    REQUIRE(read.lines().size() == 1);
    CHECK(read.diagnostics.findings()[0].place == Place{20, 13});
    CHECK(read.diagnostics.findings()[0].hint == "6 or 8 observers would");
}

TEST_CASE("limits that no order keeps to are errors of the protocol", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[object]]\nid = \"b\"\nshipped = \"runner\"\n[[material]]\n"
                        "id = \"x\"\nkind = \"diffuse\"\n[[task]]\nid = \"age\"\nquestion = \"?\"\n"
                        "stimuli = \"once-per-object\"\n[schedule]\nmax_task_run = 1\n");
    CHECK(read.lines() ==
          Lines{"23:16: no order keeps to runs of 1 with the same task: one task has 4 of the 6 trials"});
    CHECK(read.diagnostics.findings()[0].hint == "allow runs of 2 at least, or 0 for no limit");
}

TEST_CASE("a limit of the schedule that a block's order drops is warned of, unless the block has its own",
          "[unit]") {
    const std::string more = "[[object]]\nid = \"b\"\nshipped = \"runner\"\n[schedule]\n"
                             "max_object_run = 1\n[[block]]\nid = \"one\"\norder = \"blocked\"\n"
                             "by = \"stimulus\"\n";
    const ReadText read(minimal_protocol, more);
    REQUIRE(read.protocol);
    REQUIRE(read.lines() == Lines{"16:18: this limit does not hold in block \"one\" (blocked by stimulus), "
                                  "whose order says otherwise"});
    CHECK(ReadText(minimal_protocol, more + "max_object_run = 0\n").lines().empty());
    // The default of 2 was never asked for.
    CHECK(ReadText(minimal_protocol, "[[object]]\nid = \"b\"\nshipped = \"runner\"\n[[block]]\n"
                                     "id = \"one\"\norder = \"sequential\"\n")
              .lines()
              .empty());
}

TEST_CASE("text that cannot be read and pictures that do not fit are errors", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[screens]\ntext_height_deg = 0.05\n").lines() ==
          Lines{"13:19: text of 0.05 deg is 4.2 px high: too small to be read"});
    CHECK(ReadText(minimal_protocol, "[screens]\ntext_height_deg = 2\n").lines() ==
          Lines{"13:19: text of 2 deg is 168 px high: too large for a screen of 1080 rows"});
    CHECK(ReadText(minimal_protocol, "[view]\nheight_px = 1200\n").lines() ==
          Lines{"13:13: the image is 1200 px high, the screen only 1080 px"});
    CHECK(ReadText(minimal_protocol, "[display]\nwidth_px = 1919\n").lines() ==
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
