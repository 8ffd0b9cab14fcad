/// Which levels a match has, what its slot begins with, and what is wrong where there are none.
#include "experiment/design/match_levels.h"

#include "experiment/design/answer_forms.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Two slots; the test shows each material, the other is set.
constexpr std::string_view matched_protocol = R"([protocol]
name = "match"
[animation]
kind = "still"
duration_s = 1
[[light]]
id = "hall"
[[light]]
id = "sky"
probe = "overcast"
[[slot]]
id = "test"
right_deg = -8
size_deg = 6
[[slot]]
id = "reference"
right_deg = 8
size_deg = 6
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "rough-conductor"
series = { roughness = [0.4, 0.1, 0.2] }
[[material]]
id = "silver"
kind = "rough-conductor"
metal = "Ag"
columns = { base = "silver" }
series = { roughness = [0.05, 0.3] }
[[task]]
id = "t"
question = "Match."
slots = ["test", "reference"]
trials = { rule = "every", of = ["material", "light"], in = "test" }
steps = [ { show = ["test", "reference"], until = "answer" } ]
[[task.answer]]
id = "gloss"
kind = "match"
slot = "reference"
along = "roughness"
)";

std::string with_match(std::string_view more) { return std::string(matched_protocol) + std::string(more); }

const Trial& match_trial_with(const std::vector<Trial>& trials, const Protocol& protocol,
                              std::string_view material, int light) {
    for (const Trial& trial : trials)
        if (protocol.material_of(trial.stimulus).id == material && trial.stimulus.light == light)
            return trial;
    throw std::runtime_error("no such trial");
}

} // namespace

TEST_CASE("levels are the entries that are alike in all else, rising; the reference is what stands beside",
          "[unit]") {
    const ReadText read(with_match("shows = { light = \"sky\" }\n"));
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    const std::vector<Trial> trials = trials_of(protocol, 1);
    REQUIRE(trials.size() == 10);
    const TaskAnswer& answer = protocol.tasks.front().answers.front();
    const Trial& gold = match_trial_with(trials, protocol, "gold-0.2", 0);
    REQUIRE(gold.beside.size() == 1);
    CHECK(gold.beside.front().slot == 1);
    const MatchLevels levels = match_levels(protocol, answer, gold);
    REQUIRE(levels.axes.size() == 1);
    CHECK(levels.axes.front().values == std::vector<double>{0.1, 0.2, 0.4});
    CHECK(levels.axes.front().reference == 0.2);
    CHECK(levels.place == 1);
    CHECK(levels.slot == 1);
    std::vector<std::string> ids;
    for (const Stimulus& stimulus : levels.stimuli) {
        ids.push_back(protocol.material_of(stimulus).id);
        CHECK(protocol.light_of(stimulus).id == "sky");
        CHECK(stimulus.object == gold.stimulus.object);
    }
    CHECK(ids == std::vector<std::string>{"gold-0.1", "gold-0.2", "gold-0.4"});
    CHECK(gold.beside.front().stimulus == levels.stimuli.front());

    const MatchLevels silver =
        match_levels(protocol, answer, match_trial_with(trials, protocol, "silver-0.3", 1));
    CHECK(silver.axes.front().values == std::vector<double>{0.05, 0.3});
    CHECK(silver.axes.front().reference == 0.3);

    std::vector<std::size_t> first_levels;
    const std::vector<PlacedStimulus> loaded = loaded_for(protocol, gold, &first_levels);
    CHECK(first_levels == std::vector<std::size_t>{2});
    REQUIRE(loaded.size() == 5);
    CHECK(loaded[3] == PlacedStimulus{levels.stimuli[1], 1});
}

TEST_CASE("a match begins where the protocol says, or at each level about equally often", "[unit]") {
    const auto starts = [](std::string_view more) {
        const ReadText read(with_match(more));
        INFO(read.diagnostics.print());
        REQUIRE(read.protocol);
        std::vector<int> count(3);
        Trial trial = match_trial_with(trials_of(*read.protocol, 1), *read.protocol, "gold-0.1", 0);
        for (trial.index = 0; trial.index < 300; ++trial.index) {
            const std::vector<AnswerForm> forms = answer_forms({*read.protocol, trial, 7}, {0}, 0);
            ++count.at(static_cast<std::size_t>(forms.front().levels.axes.front().start));
            CHECK(answer_forms({*read.protocol, trial, 7}, {0}, 0).front().levels.axes.front().start ==
                  forms.front().levels.axes.front().start);
        }
        return count;
    };
    CHECK(starts("start = \"low\"\n") == std::vector<int>{300, 0, 0});
    CHECK(starts("start = \"high\"\n") == std::vector<int>{0, 0, 300});
    const std::vector<int> drawn = starts("");
    for (const int count : drawn) {
        CHECK(count > 70);
        CHECK(count < 130);
    }
}

TEST_CASE("what cannot be set is an error at its place", "[unit]") {
    const auto fault = [](std::string text, std::string_view replaced, std::string_view by) {
        if (const std::size_t at = text.find(replaced); !replaced.empty() && at != std::string::npos)
            text.replace(at, replaced.size(), by);
        const ReadText read(text);
        std::string all;
        for (const std::string& line : read.lines())
            all += line + "\n";
        CHECK_FALSE(read.protocol);
        return all;
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(fault(with_match(""), "along = \"roughness\"", "along = \"shine\""),
               Contains("no entry has a number in a column \"shine\""));
    CHECK_THAT(fault(with_match("start = 0.15\n"), "", ""), Contains("no level of \"roughness\" is 0.15"));
    CHECK_THAT(fault(with_match(""), "slot = \"reference\"", "slot = \"left\""),
               Contains("the task has no slot \"left\""));
    CHECK_THAT(fault(with_match(""), "slot = \"reference\"\n", ""),
               Contains("does not say in which of the 2 slots"));
    CHECK_THAT(fault(with_match("keys = [\"f\"]\n"), "", ""), Contains("has 2 keys"));
    CHECK_THAT(fault(with_match("keys = [\"enter\", \"j\"]\n"), "", ""),
               Contains("the key \"enter\" answers two things"));
    CHECK_THAT(fault(with_match(""), "until = \"answer\"", "for_s = 1"), Contains("nothing is shown while"));
    CHECK_THAT(fault(with_match(""), "columns = { base = \"silver\" }\nseries = { roughness = [0.05, 0.3] }",
                     "series = { roughness = [0.1, 0.3] }"),
               Contains("2 materials have roughness 0.1: which is meant nobody can tell"));
    CHECK_THAT(fault(with_match("shows = { light = \"moon\" }\n"), "", ""),
               Contains("there is no light \"moon\""));
    // Two pictures fit, and three levels do not.
    CHECK_THAT(fault(with_match(""), "name = \"match\"", "name = \"match\"\n[display]\nframe_store_mb = 2.5"),
               Contains("what can be set in a trial of task t takes"));
}

TEST_CASE("two columns need each value of the one with each of the other", "[unit]") {
    const auto grid = [](std::string_view materials) {
        std::string text = with_match("");
        const std::size_t begin = text.find("[[material]]"), end = text.find("[[task]]");
        text.replace(begin, end - begin, materials);
        text.replace(text.find("along = \"roughness\""), 19, "along = [\"roughness\", \"shade\"]");
        return text;
    };
    const ReadText whole(grid(R"([[material]]
id = "dark"
kind = "rough-conductor"
columns = { shade = 1 }
series = { roughness = [0.1, 0.2, 0.3] }
[[material]]
id = "bright"
kind = "rough-conductor"
columns = { shade = 2 }
series = { roughness = [0.1, 0.2, 0.3] }
)"));
    INFO(whole.diagnostics.print());
    REQUIRE(whole.protocol);
    const std::vector<Trial> trials = trials_of(*whole.protocol, 1);
    const MatchLevels levels =
        match_levels(*whole.protocol, whole.protocol->tasks.front().answers.front(), trials.front());
    REQUIRE(levels.stimuli.size() == 6);
    CHECK(whole.protocol->material_of(levels.stimuli[static_cast<std::size_t>(levels.level_of(1, 1))]).id ==
          "bright-0.2");
    const ReadText lacking(grid(R"([[material]]
id = "dark"
kind = "rough-conductor"
columns = { shade = 1 }
series = { roughness = [0.1, 0.2, 0.3] }
[[material]]
id = "bright"
kind = "rough-conductor"
columns = { shade = 2 }
series = { roughness = [0.1, 0.2] }
)"));
    CHECK_FALSE(lacking.protocol);
    CHECK_THAT(lacking.diagnostics.print(),
               Catch::Matchers::Contains("there is no material with roughness 0.3 and shade 2"));
}
