/// Lists of points, probes and gauges that cannot be, at their places.
#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

using PointLines = std::vector<std::string>;

/// A list in line 12 and what follows, then a task whose steps wait for a gauge.
PointLines findings_of_list(const std::string& list) {
    return ReadText(minimal_protocol, "[[points]]\nid = \"p\"\n" + list + "\n").lines();
}

/// A list "p" of three places in lines 12 to 14, and this of a task from line 15 on.
PointLines findings_of_task(const std::string& steps, const std::string& rest) {
    return ReadText(minimal_protocol, "[[points]]\nid = \"p\"\nevenly = 3\n[[task]]\nid = \"t\"\nquestion = "
                                      "\"Which?\"\nsteps = [" +
                                          steps + "]\n" + rest)
        .lines();
}

const std::string shown_until = "{ show = \"centre\", until = \"answer\" }";
const std::string a_probe = "[[task.probe]]\nid = \"place\"\npoints = \"p\"\n";
const std::string a_gauge = "[[task.answer]]\nid = \"lean\"\nkind = \"gauge\"\n";

} // namespace

TEST_CASE("lists of points say in one way where their places are", "[unit]") {
    CHECK(findings_of_list("evenly = 40\narea = \"head\"\nfacing_deg = 60\nseed = 3").empty());
    CHECK(findings_of_list("vertices = [3, 8]\nplaces = [[4, 0.2, 0.3]]\nnear_mm = [1, 2, 3]").empty());
    CHECK(findings_of_list("") == PointLines{"13:6: nothing says where the places of \"p\" are"});
    CHECK(findings_of_list("evenly = 4\nvertices = [3]") ==
          PointLines{"15:12: the places of \"p\" are given one by one, and spread evenly"});
    CHECK(findings_of_list("vertices = [3]\narea = \"head\"") ==
          PointLines{"15:8: \"area\" is of places that are spread, and those of \"p\" are given"});
    CHECK(findings_of_list("vertices = [2.5]") == PointLines{"14:12: 2.5 is no number of a vertex"});
    CHECK(findings_of_list("evenly = 4\nobject = \"b\"") == PointLines{"15:10: there is no object \"b\""});
    CHECK(findings_of_list("evenly = 4\nframe = 3") ==
          PointLines{"15:9: nothing asks what is seen in a frame"});
    CHECK(findings_of_list("evenly = 4\nfacing_deg = 60\nframe = 61") ==
          PointLines{"16:9: there is no frame 61"});
    CHECK(findings_of_list("vertices = [1]\n[[object]]\nid = \"b\"\nshipped = \"runner\"") ==
          PointLines{
              "14:12: numbers of vertices and triangles are of one mesh, and \"p\" does not say of which"});
    CHECK(findings_of_list("evenly = 4\n[[points]]\nid = \"p\"\nevenly = 3").size() == 1);
}

TEST_CASE("lists of one id are of different objects and correspond by their numbers", "[unit]") {
    const std::string two = "[[object]]\nid = \"b\"\nshipped = \"runner\"\n[[object]]\nid = \"c\"\nshipped = "
                            "\"runner\"\n";
    const auto findings = [&](const std::string& of_c) {
        return findings_of_list("object = \"b\"\nvertices = [1, 2]\n[[points]]\nid = \"p\"\n" + of_c + "\n" +
                                two);
    };
    CHECK(findings("object = \"c\"\nnear_mm = [[1, 2, 3], [4, 5, 6]]").empty());
    CHECK(findings("object = \"b\"\nvertices = [1, 2]") == PointLines{"17:6: the id \"p\" is there twice"});
    CHECK(findings("near_mm = [[1, 2, 3], [4, 5, 6]]") == PointLines{"17:6: the id \"p\" is there twice"});
    CHECK(findings("object = \"c\"\nvertices = [1]") ==
          PointLines{"17:6: \"p\" has 2 places on \"b\" and 1 on \"c\": places of one id correspond by "
                     "their numbers"});
    CHECK(findings("object = \"c\"\nevenly = 2") ==
          PointLines{
              "17:6: the places of \"p\" on several objects correspond, and places that are spread evenly "
              "do not"});
}

TEST_CASE("probes know their list, their slot and their name", "[unit]") {
    CHECK(findings_of_task(shown_until, a_probe + a_gauge).empty());
    CHECK(findings_of_task("{ show = \"centre\" }", "[[task.probe]]\nid = \"place\"\npoints = \"q\"\n") ==
          PointLines{"21:10: there is no list of [[points]] \"q\""});
    CHECK(findings_of_task("{ show = \"centre\" }", "[[task.probe]]\nid = \"object\"\npoints = \"p\"\n") ==
          PointLines{"20:6: tables have a column \"object\" already, and the probe's is called by its id"});
    CHECK(findings_of_task("{ show = \"centre\", probes = [\"plaice\"] }", a_probe) ==
          PointLines{"18:38: task t has no probe \"plaice\""});
    CHECK(findings_of_task("{ show = \"centre\" }", a_probe + "slot = \"left\"\n").size() == 1);
    CHECK(findings_of_task("{ show = \"centre\" }", a_probe + a_probe).size() == 1);
    // Four different places of three.
    std::string four;
    for (const char* const id : {"w", "x", "y", "z"})
        four += fmt::format("[[task.probe]]\nid = \"{}\"\npoints = \"p\"\n", id);
    CHECK(findings_of_task("{ show = \"centre\" }", four) ==
          PointLines{"21:10: 4 probes stand at different places of \"p\", which has 3"});
    CHECK(findings_of_task("{ show = \"centre\" }", "draw_points = 2\n") ==
          PointLines{"19:15: task t has no probe whose places could be drawn"});
    CHECK(findings_of_task("{ show = \"centre\" }", "draw_points = 9\n" + a_probe) ==
          PointLines{"19:15: of 3 places or sets of places nothing like 9 can be drawn"});
}

TEST_CASE("the places of a list are on the objects that a task shows", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[task.probe]]\nid = \"place\"\npoints = \"p\"\n[[points]]\nid = \"p\"\nobject = "
                        "\"a\"\nevenly = 3\n[[object]]\nid = \"b\"\nshipped = \"runner\"\n");
    CHECK(read.lines() ==
          PointLines{"14:10: task free shows object \"b\", and the places of \"p\" are on another"});
}

TEST_CASE("a gauge has a probe, stands alone, and is set while its place is shown", "[unit]") {
    CHECK(findings_of_task(shown_until, a_gauge) ==
          PointLines{"21:8: the gauge \"lean\" has no place to stand at"});
    CHECK(findings_of_task(shown_until, a_probe + a_gauge + "probe = \"plaice\"\n") ==
          PointLines{"25:9: there is no probe \"plaice\""});
    CHECK(findings_of_task("{ show = \"centre\" }, { answer = \"lean\" }", a_probe + a_gauge) ==
          PointLines{"24:8: nothing is shown while \"lean\" is set"});
    CHECK(findings_of_task(shown_until, a_probe + a_gauge + "undo_key = \"enter\"\n") ==
          PointLines{"25:12: the key \"enter\" answers two things"});
    CHECK(findings_of_task(shown_until, a_probe + a_gauge +
                                            "[[task.answer]]\nid = \"k\"\nkind = \"key\"\nkeys = [\"f\"]\n")
              .size() == 1);
    CHECK(findings_of_task(shown_until, a_probe + a_gauge + "simulated = { shear = [1] }\n").size() == 1);
    CHECK(findings_of_task(shown_until, a_probe + a_gauge + "steps = 3\n") ==
          PointLines{"25:9: an answer of kind \"gauge\" has no \"steps\""});
}

TEST_CASE("a point by gaze needs a key, and one by the mouse has none", "[unit]") {
    const std::string point = "[[task.answer]]\nid = \"where\"\nkind = \"point\"\n";
    CHECK(findings_of_task(shown_until, point).empty());
    CHECK(findings_of_task(shown_until, point + "by = \"gaze\"\nkeys = [\"space\"]\n").empty());
    CHECK(findings_of_task(shown_until, point + "by = \"fixation\"\n") ==
          PointLines{"22:6: nothing says with which key \"where\" is given"});
    CHECK(findings_of_task(shown_until, point + "keys = [\"space\"]\n") ==
          PointLines{"22:8: a point that is clicked on needs no keys"});
}
