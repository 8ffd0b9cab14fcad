/// What entries are called that a protocol gives no id, and how short a protocol can be.
#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/design/schedule.h"
#include "experiment/protocol/all_stimuli.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

using Names = std::vector<std::string_view>;
using Lines = std::vector<std::string>;

std::size_t list_of(std::string_view name) {
    const auto row = std::ranges::find(stimulus_lists, name, &StimulusList::name);
    REQUIRE(row != stimulus_lists.end());
    return static_cast<std::size_t>(row - stimulus_lists.begin());
}

/// Two objects with four areas each, two lights and three roughnesses, on a rig of one's own.
constexpr std::string_view first_protocol = R"([protocol]
name = "lights_and_gloss"
[display]
refresh_hz = 60
width_mm = 531
height_mm = 299
viewing_distance_mm = 600
output = "native-8bit"
gamma = 2.2
linearised_by = "none"
[tracker]
kind = "eyelink"
[[object]]
series = { mesh = ["scans/vase.ply", "scans/bowl.ply"] }
areas.rim.planes = [[[0, 0, 90], [0, 0, 1]]]
areas.handle.boxes = [[[40, -10, 20], [70, 10, 80]]]
areas.foot.planes = [[[0, 0, 10], [0, 0, -1]]]
areas.spout.spheres = [[-50, 0, 60, 15]]
[[light]]
series = { probe = ["gallery", "overcast"] }
[[material]]
kind = "rough-conductor"
series = { roughness = [0.05, 0.15, 0.4] }
[[task]]
question = "Look at the material."
)";

} // namespace

TEST_CASE("two objects, two lights, three roughnesses and four areas take no more than 25 lines", "[unit]") {
    CHECK(std::ranges::count(first_protocol, '\n') <= 25);
    const ReadText read(first_protocol);
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    CHECK(ids_in_list(protocol, list_of("object")) == Names{"vase", "bowl"});
    CHECK(ids_in_list(protocol, list_of("light")) == Names{"gallery", "overcast"});
    CHECK(ids_in_list(protocol, list_of("material")) ==
          Names{"rough-conductor-0.05", "rough-conductor-0.15", "rough-conductor-0.4"});
    CHECK(protocol.tasks.front().id == "task");
    for (const ObjectSettings& object : protocol.objects)
        CHECK(object.areas.size() == 4);
    const Schedule schedule = make_schedule(protocol, {"P01", 1}, 1);
    std::set<Stimulus> shown;
    for (const Trial& trial : schedule.trials)
        shown.insert(trial.stimulus);
    CHECK(shown.size() == 2 * 2 * 3);
    // Roughness is a factor by its numbers.
    const Factors factors = factors_of(protocol);
    const Factor* const roughness = factors.find("roughness");
    REQUIRE(roughness);
    CHECK(roughness->levels.size() == 3);
}

TEST_CASE("entries without an id are called by what they are made from", "[unit]") {
    const std::string text =
        "[protocol]\nname = \"x\"\n[[task]]\nquestion = \"a\"\n[[task]]\nquestion = \"b\"\n"
        "[[object]]\nshipped = \"muse\"\n[[object]]\nmesh = \"my scans/Old Vase.ply\"\n"
        "[[material]]\nkind = \"diffuse\"\n[[material]]\nid = \"own\"\nkind = \"diffuse\"\n"
        "[[light]]\nprobe = \"gallery\"\n[[light]]\n"
        "[[background]]\ngrey = 0.2\n";
    const ReadText read(text);
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    CHECK(ids_in_list(protocol, list_of("object")) == Names{"muse", "Old_Vase"});
    CHECK(ids_in_list(protocol, list_of("material")) == Names{"diffuse", "own"});
    CHECK(ids_in_list(protocol, list_of("light")) == Names{"gallery", "light"});
    // The only entry of a list that is never empty has the list's name.
    CHECK(ids_in_list(protocol, list_of("background")) == Names{"background"});
    CHECK(protocol.tasks[1].id == "task-2");
    // Two of one name are told at the second, which may then be given an id.
    CHECK(ReadText(text, "[[material]]\nkind = \"diffuse\"\n").lines() ==
          Lines{"21:1: id \"diffuse\" is taken already"});
}

TEST_CASE("a background is one of a grey, a colour and a picture, and a factor", "[unit]") {
    const std::string two = "[[background]]\nid = \"dark\"\ngrey = 0.05\n"
                            "[[background]]\nid = \"red\"\ncolour = [0.5, 0, 0]\n";
    const ReadText read(minimal_protocol, two);
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    CHECK(all_stimuli(*read.protocol).size() == 2);
    REQUIRE(factors_of(*read.protocol).find("background"));
    CHECK(stimulus_name(*read.protocol, all_stimuli(*read.protocol)[1]) == "a/gold/red");
    CHECK(ReadText(minimal_protocol, "[background]\ngrey = 0.2\ncolour = [0, 0, 1]\n").lines() ==
          Lines{"14:10: \"grey\" already says what is behind the object"});
}
