#include "experiment/protocol/files/old_words.h"

#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Lines = std::vector<std::string>;

namespace {

constexpr std::string_view earlier = R"([protocol]
name = "earlier"
[[sculpture]]
id = "a"
shipped = "muse"
[[sculpture]]
id = "b"
shipped = "runner"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "free"
question = "Look."
stimuli = "once-per-sculpture"
[schedule]
max_sculpture_run = 3
min_sculpture_distance = 0
[[block]]
id = "all"
sculptures = ["b", "a"]
order = "blocked"
by = "sculpture"
max_sculpture_run = 1
[[practice]]
task = "free"
sculpture = "a"
material = "gold"
)";

/// The same in words of today, with as many letters in each line as it needs.
std::string in_words_of_today() {
    std::string text(earlier);
    for (std::size_t at = 0; (at = text.find("sculpture", at)) != std::string::npos;)
        text.replace(at, 9, "object");
    return text;
}

} // namespace

TEST_CASE("earlier words mean what today's do, and one note tells of them", "[unit]") {
    const ReadText old(earlier), today(in_words_of_today());
    REQUIRE(old.protocol);
    REQUIRE(today.protocol);
    CHECK(today.lines().empty());
    CHECK(old.lines() ==
          Lines{"3:3: \"sculpture\" is the earlier word for \"object\"; it is read as that, here "
                "and in 7 other places"});
    CHECK(old.diagnostics.findings().at(0).severity == Severity::note);
    CHECK(old.diagnostics.warning_count() == 0);
    for (const Protocol* protocol : {&*old.protocol, &*today.protocol}) {
        REQUIRE(protocol->objects.size() == 2);
        CHECK(protocol->objects[1].id == "b");
        CHECK(protocol->tasks.at(0).stimuli == TaskCoverage::once_per_object);
        CHECK(protocol->schedule.max_object_run == 3);
        CHECK(protocol->blocks.at(0).chosen[0] == std::vector<std::string>{"b", "a"});
        CHECK(protocol->blocks.at(0).max_object_run == 1);
        CHECK(protocol->practice.at(0).entries[0] == "a");
        CHECK(protocol->blocks.at(0).by == "object");
    }
}

TEST_CASE("an object whose id is an earlier word keeps it, and so do words that are not overt's own",
          "[unit]") {
    std::string text(minimal_protocol);
    text.replace(text.find("id = \"a\""), 8, "id = \"sculpture\"");
    text += "[[practice]]\ntask = \"free\"\nobject = \"sculpture\"\nmaterial = \"gold\"\n";
    const ReadText read(text);
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    CHECK(read.protocol->objects.at(0).id == "sculpture");
    CHECK(read.protocol->practice.at(0).entries[0] == "sculpture");
}

TEST_CASE("one list under both words is refused", "[unit]") {
    const ReadText read(minimal_protocol, "[[sculpture]]\nid = \"b\"\nshipped = \"runner\"\n");
    CHECK_FALSE(read.protocol);
    CHECK(read.diagnostics.error_count() == 1);
    CHECK(read.lines().at(0) ==
          "12:3: \"sculpture\" is the earlier word for \"object\", which is written, too");
}

TEST_CASE("a factor that was called otherwise is found by its earlier name", "[unit]") {
    CHECK(todays_factor("sculpture") == "object");
    CHECK(todays_factor("material") == "material");
    CHECK(todays_factor("").empty());
}
