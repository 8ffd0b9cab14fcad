/// What a protocol opens is named before it runs; code it cannot name at all.
#include <algorithm>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "experiment/checks/opened_things.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

std::vector<std::string> opened(const std::string& more) {
    const ReadText read(minimal_protocol, more);
    REQUIRE(read.protocol);
    std::vector<std::string> lines;
    for (const OpenedThing& thing : opened_by(*read.protocol))
        lines.push_back(fmt::format("{} | {} | {}", thing.kind, thing.whose, thing.what));
    return lines;
}

/// Of what a protocol opens, the files; the minimal one opens its display's box besides.
std::vector<std::string> files_outside(const Protocol& protocol) {
    std::vector<std::string> lines;
    for (const OpenedThing& thing : opened_by(protocol))
        if (thing.kind == "file outside")
            lines.push_back(fmt::format("{} | {}", thing.whose, thing.what));
    return lines;
}

bool has_line(const std::vector<std::string>& lines, const std::string& line) {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
}

} // namespace

TEST_CASE("a library that a protocol names is not taken, and that is said at its place", "[unit]") {
    for (const std::string section :
         {"[tracker]\nkind = \"lsl\"\n", "[[further_tracker]]\nid = \"b\"\nkind = \"lsl\"\n",
          "[[marker_output]]\nid = \"m\"\nkind = \"lsl\"\n"}) {
        const ReadText read(minimal_protocol, section + "library = \"./helpful.so\"\n");
        CAPTURE(section, read.lines());
        REQUIRE(read.protocol);
        REQUIRE(read.lines().size() == 1);
        CHECK_THAT(read.lines().front(), Contains(":1: ") && Contains("is not loaded from here"));
        CHECK_THAT(read.diagnostics.print(), Contains("--library"));
        for (const OpenedThing& thing : opened_by(*read.protocol))
            CHECK_THAT(thing.what, !Contains("helpful"));
    }
}

TEST_CASE("each library, address, port and device that a protocol opens is named", "[unit]") {
    unsetenv("OVERT_LSL_LIBRARY");
    unsetenv("OVERT_EYELINK_LIBRARY");
    const std::vector<std::string> lines =
        opened("[tracker]\nkind = \"eyelink\"\noutlet = true\n"
               "[[further_tracker]]\nid = \"second\"\nkind = \"opengaze\"\naddress = \"10.0.0.7:4242\"\n"
               "[[further_tracker]]\nid = \"third\"\nkind = \"replay\"\naddress = \"/home/a/gaze.asc\"\n"
               "[[button_box]]\nid = \"pad\"\nkind = \"xid\"\naddress = \"/dev/ttyUSB3\"\n"
               "[[marker_output]]\nid = \"eeg\"\naddress = \"/dev/ttyUSB1\"\ncodes = [\"onset 1\"]\n"
               "[[marker_output]]\nid = \"lines\"\nkind = \"parallel\"\ncodes = [\"onset 1\"]\n"
               "[answers]\nrecord = \"required\"\ndevice = \"Scarlett\"\n"
               "[display]\noutput = \"mono++\"\nbox = \"/dev/ttyACM4\"\n");
    CAPTURE(lines);
    CHECK(has_line(lines, "library | [tracker] | the EyeLink's library: libeyelink_core.so, from where the "
                          "system looks"));
    CHECK(has_line(lines,
                   "library | [tracker] outlet | the library of the Lab Streaming Layer: liblsl.so.2 or "
                   "liblsl.so or liblsl.so.1 or liblsl64.so, from where the system looks"));
    CHECK(has_line(lines,
                   "device or address | [tracker] | the network address 100.1.1.1 (no address is given)"));
    CHECK(has_line(lines, "device or address | [[further_tracker]] \"second\" | 10.0.0.7:4242"));
    CHECK(has_line(lines, "file | [[further_tracker]] \"third\" | /home/a/gaze.asc"));
    CHECK(has_line(lines, "device or address | [[button_box]] \"pad\" | /dev/ttyUSB3"));
    CHECK(has_line(lines, "device or address | [[marker_output]] \"eeg\" | /dev/ttyUSB1"));
    CHECK(has_line(lines,
                   "device or address | [[marker_output]] \"lines\" | /dev/parport0 (no address is given)"));
    CHECK(has_line(lines, "microphone | [answers] | Scarlett"));
    CHECK(has_line(lines, "device or address | [display] box | /dev/ttyACM4"));
    // Samples that are made up are not sent on.
    for (const std::string& line : opened("[tracker]\noutlet = true\n"))
        CHECK_THAT(line, !Contains("outlet"));
    setenv("OVERT_EYELINK_LIBRARY", "/opt/eyelink/core.so", 1);
    CHECK(has_line(opened("[tracker]\nkind = \"eyelink\"\n"),
                   "library | [tracker] | the EyeLink's library: /opt/eyelink/core.so, by "
                   "OVERT_EYELINK_LIBRARY of the environment or --library"));
    unsetenv("OVERT_EYELINK_LIBRARY");
}

TEST_CASE("files outside of the protocol's folder are named, and those inside are not", "[unit]") {
    ReadText read(minimal_protocol,
                  "[[object]]\nid = \"b\"\nmesh = \"../../etc/scan.ply\"\n[[object]]\nid = \"c\"\nmesh = "
                  "\"a/../b.ply\"\n"
                  "[[light]]\nprobe = \"/srv/sky.exr\"\n[calibration]\nbeeps = false\n");
    REQUIRE(read.protocol);
    for (const std::string file : {"p.toml", "study/p.toml"}) { // the first names no folder
        read.protocol->file = file;
        for (ObjectSettings& object : read.protocol->objects)
            if (object.id == "c")
                object.mesh = read.protocol->file.parent_path() / "a/../b.ply";
        const std::vector<std::string> lines = files_outside(*read.protocol);
        CAPTURE(file, lines);
        REQUIRE(lines.size() == 2);
        CHECK(lines[0] == "[[object]] \"b\" | ../../etc/scan.ply");
        CHECK_THAT(lines[1], Contains("/srv/sky.exr"));
    }
    CHECK_THAT(to_text(std::vector<OpenedThing>()), Contains("nothing"));
}
