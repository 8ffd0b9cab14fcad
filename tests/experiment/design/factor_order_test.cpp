/// Orders, blocks, groups and limits by any factor.
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/checks/design_report.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/schedule.h"
#include "experiment/protocol/marker_codes.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// Two objects, three roughnesses, two lights: twelve stimuli; what a test adds begins in line 25.
constexpr std::string_view twelve = R"([protocol]
name = "twelve"
[[object]]
id = "a"
shipped = "muse"
columns = { size = "small" }
[[object]]
id = "b"
shipped = "runner"
columns = { size = "large" }
[[material]]
id = "gloss"
kind = "rough-conductor"
series = { roughness = [0.1, 0.2, 0.4] }
[[light]]
id = "hall"
probe = "gallery"
[[light]]
id = "sky"
[[task]]
id = "free"
question = "Look."
[schedule]
max_object_run = 0
)";

Protocol sound(std::string_view more) {
    const ReadText read(twelve, more);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

std::vector<int> levels(const Protocol& protocol, const Schedule& schedule, std::string_view factor) {
    const Factors factors = factors_of(protocol);
    std::vector<int> all;
    for (const Trial& trial : schedule.trials)
        all.push_back(factors.level_of(factors.at(factor), trial));
    return all;
}

int longest(const std::vector<int>& levels) {
    int longest = 0, run = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        run = i > 0 && levels[i] == levels[i - 1] ? run + 1 : 1;
        longest = std::max(longest, run);
    }
    return longest;
}

} // namespace

TEST_CASE("each stimulus of all lists is shown once", "[unit]") {
    const Protocol protocol = sound("");
    const Schedule schedule = make_schedule(protocol, {"P1", 1}, 7);
    std::set<Stimulus> seen;
    for (const Trial& trial : schedule.trials)
        seen.insert(trial.stimulus);
    CHECK(schedule.trials.size() == 12);
    CHECK(seen.size() == 12);
    CHECK(seen.rbegin()->light == 1);
}

TEST_CASE("stimuli are numbered by all lists, there and back", "[unit]") {
    const Factors factors = factors_of(sound(""));
    REQUIRE(factors.stimulus_count() == 12);
    for (int number = 0; number < 12; ++number)
        CHECK(factors.level_of(factors.at("stimulus"), {}, factors.stimulus_at(number)) == number);
    CHECK(factors.stimulus_at(1) == Stimulus{0, 0, 1});
    CHECK(factors.stimulus_at(11) == Stimulus{1, 2, 1});
}

TEST_CASE("runs and distances of any list or column are kept, in each of many orders", "[unit]") {
    const Protocol runs = sound("max_run = { light = 1, roughness = 2 }\n");
    const Protocol distances = sound("min_distance = { roughness = 3 }\n");
    ScheduleMaker of_runs(runs), of_distances(distances);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Schedule one = of_runs.make({"P1", 1}, seed), other = of_distances.make({"P1", 1}, seed);
        CHECK(longest(levels(runs, one, "light")) == 1);
        CHECK(longest(levels(runs, one, "roughness")) <= 2);
        const std::vector<int> roughness = levels(distances, other, "roughness");
        for (std::size_t i = 2; i < roughness.size(); ++i)
            CHECK(std::set(roughness.begin() + static_cast<int>(i) - 2,
                           roughness.begin() + static_cast<int>(i) + 1)
                      .size() == 3);
        CHECK(one.is_even);
    }
}

TEST_CASE("a limit by name is the limit of the key of that name: the same orders from the same seeds",
          "[unit]") {
    const std::string text = text_of_file(source_path("protocols/overt_2019.toml"));
    std::string named = text;
    const std::string key = "max_object_run = 2\n";
    named.replace(named.find(key), key.size(), "max_run = { object = 2 }\n");
    const ReadText one(text), other(named);
    REQUIRE(one.protocol);
    REQUIRE(other.protocol);
    for (int number = 1; number <= 12; ++number)
        CHECK(make_schedule(*one.protocol, {"P", number}, 2019).trials ==
              make_schedule(*other.protocol, {"P", number}, 2019).trials);
}

TEST_CASE("a block goes by any factor, and chooses of any list", "[unit]") {
    const Protocol protocol =
        sound("[[block]]\nid = \"one\"\norder = \"blocked\"\nby = \"roughness\"\n"
              "levels = \"fixed\"\nlights = [\"sky\"]\n"
              "[[block]]\nid = \"two\"\nlights = [\"hall\"]\nmaterials = [\"gloss-0.4\"]\n");
    const Schedule schedule = make_schedule(protocol, {"P1", 1}, 3);
    REQUIRE(schedule.trials.size() == 8);
    const std::vector<int> roughness = levels(protocol, schedule, "roughness"),
                           light = levels(protocol, schedule, "light");
    CHECK(roughness == std::vector<int>{0, 0, 1, 1, 2, 2, 2, 2});
    CHECK(light == std::vector<int>{1, 1, 1, 1, 1, 1, 0, 0});
}

TEST_CASE("a block that goes by a column has a weight for each of its levels", "[unit]") {
    const Protocol protocol = sound("[[block]]\nid = \"one\"\norder = \"weighted\"\nby = \"roughness\"\n"
                                    "weights = [3, 1, 0]\n");
    std::map<int, int> shown;
    for (const int level : levels(protocol, make_schedule(protocol, {"P1", 1}, 3), "roughness"))
        ++shown[level];
    CHECK(shown == std::map<int, int>{{0, 12}, {1, 4}});
}

TEST_CASE("another list than the materials goes round over the observers", "[unit]") {
    std::string text(twelve);
    text.replace(text.find("question = "), 0, "stimuli = \"once-per-object\"\n");
    const ReadText read(text + "observers = 2\nrotated_list = \"light\"\n");
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    std::map<Stimulus, int> seen;
    for (int number = 1; number <= 2; ++number) {
        const Schedule schedule = make_schedule(*read.protocol, {"P", number}, 3);
        CHECK(schedule.trials.size() == 6); // two objects in three materials, each under one light
        for (const Trial& trial : schedule.trials)
            ++seen[trial.stimulus];
    }
    CHECK(seen.size() == 12);
    CHECK(ReadText(text, "rotated_list = \"object\"\n").lines() ==
          std::vector<std::string>{"26:16: rotated_list: unknown value \"object\""});
}

TEST_CASE("groups see some entries of any list", "[unit]") {
    const Protocol protocol =
        sound("observers = 2\n[[group]]\nid = \"hall\"\nlights = [\"hall\"]\n[[group]]\n"
              "id = \"sky\"\nlights = [\"sky\"]\n");
    CHECK(levels(protocol, make_schedule(protocol, {"P1", 1}, 3), "light") == std::vector<int>(6, 0));
    CHECK(levels(protocol, make_schedule(protocol, {"P2", 2}, 3), "light") == std::vector<int>(6, 1));
}

TEST_CASE("a factor that is not there, or has one level, is refused by name with what there is", "[unit]") {
    const ReadText unknown(twelve, "[[block]]\nid = \"one\"\norder = \"blocked\"\nby = \"glos\"\n"),
        one(twelve, "[[block]]\nid = \"one\"\norder = \"blocked\"\nby = \"view\"\n"),
        limit(twelve, "max_run = { colour = 2, view = 2 }\n"),
        twice(std::string(twelve) + "max_run = { object = 2 }\n");
    CHECK(unknown.lines() == std::vector<std::string>{"28:6: there is no factor \"glos\""});
    CHECK(one.lines() == std::vector<std::string>{
                             "28:6: the factor \"view\" has one level, \"view\": there is nothing to go by"});
    CHECK_THAT(one.diagnostics.print(), Contains("object, material, light, roughness, size") ||
                                            Contains("object, material, light, size, roughness"));
    CHECK(limit.lines() ==
          std::vector<std::string>{
              "25:22: there is no factor \"colour\"",
              "25:32: the factor \"view\" has one level, \"view\": there is nothing to keep apart"});
    CHECK(twice.lines() == std::vector<std::string>{"25:22: max_object_run says it already, in line 24"});
}

TEST_CASE("two factors that always change together are told, a list and its own column are not", "[unit]") {
    const auto warnings = [](std::string_view more) { return make_design_report(sound(more), {}).warnings; };
    CHECK(warnings("").empty());
    CHECK(warnings("[[block]]\nid = \"one\"\nlights = [\"hall\"]\nobjects = [\"a\"]\n"
                   "[[block]]\nid = \"two\"\nlights = [\"sky\"]\nobjects = [\"b\"]\n") ==
          std::vector<std::string>{"object and light always change together: no analysis can tell them apart",
                                   "light and size always change together: no analysis can tell them apart"});
}

TEST_CASE("an onset's code tells levels of any factor", "[unit]") {
    Protocol protocol = sound("");
    MarkerOutputSettings output;
    output.codes = {"onset 1"};
    output.condition_codes = {"roughness 0.2 2", "roughness 0.4 4", "light sky 8"};
    const MarkerCodes codes(protocol, output);
    const auto code = [&](const Stimulus& stimulus) {
        return codes.code_of(MarkedEvent::onset, {0, 0, stimulus});
    };
    CHECK(code({0, 0, 0}) == 1);
    CHECK(code({1, 1, 0}) == 3);
    CHECK(code({1, 2, 1}) == 13);
    output.condition_codes = {"roughness 0.3 2"};
    CHECK_THROWS_WITH(MarkerCodes(protocol, output), Contains("there is no roughness \"0.3\""));
    output.condition_codes = {"colour red 2"};
    CHECK_THROWS_WITH(MarkerCodes(protocol, output), Contains("there is no factor \"colour\""));
}

TEST_CASE("check tells the lists, the columns and how often each level is shown", "[unit]") {
    const std::string text = to_text(make_design_report(sound("observers = 2\n"), {{"P1", 1}}));
    CHECK_THAT(text, Contains("2 objects x 3 materials x 2 lights = 12 stimuli; 1 task: 12 maps"));
    CHECK_THAT(text, Contains("roughness (of material): 0.1, 0.2, 0.4"));
    CHECK_THAT(text, Contains("light       hall 12, sky 12"));
}
