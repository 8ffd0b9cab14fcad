/// Each way of ordering, with 1000 seeds.
#include <cmath>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

constexpr int seeds = 1000;

/// The paper's protocol with limits taken out, and blocks.
Protocol with_blocks(std::string_view blocks, std::string_view schedule = "") {
    std::string text = text_of_file(source_path("protocols/overt_2019.toml"));
    const std::string limit = "max_object_run = 2\n";
    text.replace(text.find(limit), limit.size(), "max_object_run = 0\n" + std::string(schedule));
    const ReadText read(text, blocks);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

std::vector<std::string> findings_of(std::string_view blocks, std::string_view schedule = "") {
    std::string text = text_of_file(source_path("protocols/overt_2019.toml"));
    const std::string limit = "max_object_run = 2\n";
    text.replace(text.find(limit), limit.size(), "max_object_run = 0\n" + std::string(schedule));
    std::vector<std::string> messages;
    for (const Finding& finding : ReadText(text, blocks).diagnostics.findings())
        if (finding.message.find("no block asks") == std::string::npos)
            messages.push_back(finding.message + " | " + finding.hint);
    return messages;
}

template <class Value> int longest_run(const std::vector<Trial>& trials, Value value) {
    int longest = 0, run = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        run = i > 0 && value(trials[i]) == value(trials[i - 1]) ? run + 1 : 1;
        longest = std::max(longest, run);
    }
    return longest;
}

template <class Value> int least_distance(const std::vector<Trial>& trials, Value value) {
    int least = 1000;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        for (std::size_t j = i + 1; j < trials.size(); ++j) {
            if (value(trials[i]) == value(trials[j]))
                least = std::min(least, static_cast<int>(j - i));
        }
    }
    return least;
}

int task_of(const Trial& trial) { return trial.task; }
int object_of(const Trial& trial) { return trial.stimulus.object; }
Stimulus shown_in(const Trial& trial) { return trial.stimulus; }

std::map<std::tuple<int, int, int>, int> counts_of(const std::vector<Trial>& trials) {
    std::map<std::tuple<int, int, int>, int> counts;
    for (const Trial& trial : trials)
        ++counts[{trial.task, trial.stimulus.object, trial.stimulus.material}];
    return counts;
}

/// The orders of all seeds, each looked at: indices count up, the same seed gives the same.
std::vector<std::vector<Trial>> orders_of(const Protocol& protocol, int number = 1) {
    std::vector<std::vector<Trial>> orders;
    ScheduleMaker maker(protocol);
    for (int seed = 0; seed < seeds; ++seed) {
        const Schedule schedule = maker.make({"P", number}, static_cast<std::uint64_t>(seed));
        REQUIRE(schedule.is_even);
        REQUIRE(static_cast<int>(schedule.trials.size()) == trial_count(protocol, number));
        for (std::size_t i = 0; i < schedule.trials.size(); ++i)
            REQUIRE(schedule.trials[i].index == static_cast<int>(i));
        if (seed % 100 == 0) // from a maker that has seen nothing before
            REQUIRE(make_schedule(protocol, {"Q", number}, static_cast<std::uint64_t>(seed)).trials ==
                    schedule.trials);
        orders.push_back(schedule.trials);
    }
    return orders;
}

std::vector<Trial> of_block(const std::vector<Trial>& trials, int block) {
    std::vector<Trial> part;
    for (Trial trial : trials) {
        if (trial.block != block)
            continue;
        trial.index = static_cast<int>(part.size());
        part.push_back(trial);
    }
    return part;
}

} // namespace

TEST_CASE("random blocks follow each other, each with its trials, in 1000 orders each", "[unit]") {
    const Protocol protocol =
        with_blocks("[[block]]\nid = \"first\"\ntasks = [\"free\", \"age\"]\n"
                    "max_object_run = 1\n"
                    "[[block]]\nid = \"second\"\ntasks = \"material\"\nrepetitions = 2\n");
    std::set<std::vector<int>> firsts;
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        REQUIRE(trials.size() == 9 + 3 + 2 * 9);
        for (std::size_t i = 0; i < trials.size(); ++i)
            REQUIRE(trials[i].block == (i < 12 ? 0 : 1));
        const std::vector<Trial> first = of_block(trials, 0);
        REQUIRE(longest_run(first, object_of) == 1);
        REQUIRE(counts_of(first).size() == 12);
        // One repetition is over before the next begins.
        const std::vector<Trial> second = of_block(trials, 1);
        REQUIRE(counts_of({second.begin(), second.begin() + 9}).size() == 9);
        REQUIRE(counts_of({second.begin() + 9, second.end()}).size() == 9);
        std::vector<int> key;
        for (const Trial& trial : first)
            key.push_back(9 * trial.task + 3 * trial.stimulus.object + trial.stimulus.material);
        firsts.insert(key);
    }
    CHECK(firsts.size() == seeds);
}

TEST_CASE("a sequential block comes as it is listed, whatever the seed", "[unit]") {
    const Protocol protocol =
        with_blocks("[[block]]\nid = \"all\"\norder = \"sequential\"\n"
                    "tasks = [\"material\", \"free\"]\nobjects = [\"scholar\", \"muse\"]\n",
                    "max_material_run = 1\n");
    std::vector<std::tuple<int, int, int>> expected;
    for (const int task : {1, 0}) {
        for (const int object : {2, 0}) {
            for (const int material : {0, 1, 2})
                expected.emplace_back(task, object, material);
        }
    }
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        REQUIRE(trials.size() == expected.size());
        for (std::size_t i = 0; i < trials.size(); ++i)
            REQUIRE(std::tuple(trials[i].task, trials[i].stimulus.object, trials[i].stimulus.material) ==
                    expected[i]);
    }
}

TEST_CASE(
    "a blocked order has all trials of a level together, its levels and what is in them evenly shuffled",
    "[unit]") {
    const Protocol protocol = with_blocks("[[block]]\nid = \"all\"\norder = \"blocked\"\nby = \"object\"\n"
                                          "tasks = [\"free\", \"age\"]\nmax_task_run = 3\n");
    std::map<std::vector<int>, int> level_orders;
    std::map<int, int> first_of_level;
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        std::vector<int> levels;
        for (const Trial& trial : trials) {
            if (levels.empty() || levels.back() != trial.stimulus.object)
                levels.push_back(trial.stimulus.object);
        }
        REQUIRE(levels.size() == 3);
        REQUIRE(longest_run(trials, task_of) <= 3);
        REQUIRE(counts_of(trials).size() == 12);
        ++level_orders[levels];
        ++first_of_level[trials.front().task];
    }
    CHECK(level_orders.size() == 6);
    double chi_square = 0.0;
    for (const auto& [levels, count] : level_orders)
        chi_square += std::pow(count - seeds / 6.0, 2) / (seeds / 6.0);
    CHECK(chi_square < 20.5); // 99.9 % point for 5 degrees of freedom
    CHECK(first_of_level.size() == 2);
}

TEST_CASE("levels of a blocked order, and blocks, follow the rows of a square over the observers", "[unit]") {
    for (const std::string kind : {"cyclic", "balanced", "random-square", "fixed"}) {
        const Protocol protocol = with_blocks(
            "[[block]]\nid = \"one\"\norder = \"blocked\"\nby = \"material\"\ntasks = \"free\"\nlevels = \"" +
                kind + "\"\n[[block]]\nid = \"two\"\ntasks = \"age\"\n",
            "block_order = \"" + kind + "\"\n");
        std::map<std::pair<int, int>, int> places;
        std::map<int, int> first_blocks;
        for (int number = 1; number <= 12; ++number) {
            const std::vector<Trial> trials = make_schedule(protocol, {"P", number}, 5).trials;
            // The seed has no part in it.
            CHECK(make_schedule(protocol, {"P", number}, 6).trials.front().block == trials.front().block);
            ++first_blocks[trials.front().block];
            const std::vector<Trial> one = of_block(trials, 0);
            for (int place = 0; place < 3; ++place)
                ++places[{place, one[static_cast<std::size_t>(3 * place)].stimulus.material}];
        }
        if (kind == "fixed") {
            CHECK(places.size() == 3);
            CHECK(first_blocks.size() == 1);
            continue;
        }
        CHECK(places.size() == 9);
        for (const auto& [place, count] : places)
            CHECK(count == 4);
        CHECK(first_blocks[0] == 6);
    }
}

TEST_CASE("weights that are counts are how often each trial comes", "[unit]") {
    const Protocol protocol =
        with_blocks("[[block]]\nid = \"all\"\norder = \"weighted\"\nby = \"material\"\n"
                    "weights = [3, 1, 0]\ntasks = \"free\"\nmin_stimulus_distance = 2\n");
    CHECK(trial_count(protocol, 1) == 3 * 3 + 3);
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        const auto counts = counts_of(trials);
        REQUIRE(counts.size() == 6);
        for (const auto& [cell, count] : counts)
            REQUIRE(count == (std::get<2>(cell) == 0 ? 3 : 1));
        REQUIRE(least_distance(trials, shown_in) >= 2);
    }
}

TEST_CASE("levels that are drawn come in proportion to their weights, and their trials evenly", "[unit]") {
    const Protocol protocol = with_blocks("[[block]]\nid = \"all\"\norder = \"weighted\"\nby = \"material\"\n"
                                          "weights = [0.5, 0.3, 0.2]\ndraws = 20\ntasks = \"free\"\n");
    std::map<std::tuple<int, int, int>, int> counts;
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        REQUIRE(trials.size() == 20);
        for (const auto& [cell, count] : counts_of(trials))
            counts[cell] += count;
    }
    CHECK(counts.size() == 9);
    double chi_square = 0.0;
    constexpr double weights[] = {0.5, 0.3, 0.2};
    for (const auto& [cell, count] : counts) {
        const double mean = 20.0 * seeds * weights[std::get<2>(cell)] / 3.0;
        chi_square += std::pow(count - mean, 2) / mean;
    }
    CHECK(chi_square < 26.1); // 99.9 % point for 8 degrees of freedom
}

TEST_CASE("mixed repetitions are one order, and distances hold across all of it", "[unit]") {
    const Protocol protocol = with_blocks(
        "[[block]]\nid = \"all\"\ntasks = \"free\"\nrepetitions = 3\nrepetition_order = \"mixed\"\n"
        "min_stimulus_distance = 4\nmax_object_run = 2\n");
    bool is_ever_mixed = false;
    for (const std::vector<Trial>& trials : orders_of(protocol)) {
        REQUIRE(counts_of(trials).size() == 9);
        for (const auto& [cell, count] : counts_of(trials))
            REQUIRE(count == 3);
        REQUIRE(least_distance(trials, shown_in) >= 4);
        REQUIRE(longest_run(trials, object_of) <= 2);
        is_ever_mixed = is_ever_mixed || counts_of({trials.begin(), trials.begin() + 9}).size() < 9;
    }
    CHECK(is_ever_mixed);
}

TEST_CASE("limits hold from a block into the one that continues it, and not into others", "[unit]") {
    const std::string first = "[[block]]\nid = \"one\"\ntasks = \"free\"\nmax_object_run = 1\n"
                              "[[block]]\nid = \"two\"\ntasks = \"material\"\nmax_object_run = 1\n";
    int across = 0;
    for (const std::vector<Trial>& trials : orders_of(with_blocks(first + "continues = true\n")))
        REQUIRE(longest_run(trials, object_of) == 1);
    for (const std::vector<Trial>& trials : orders_of(with_blocks(first)))
        across += trials[8].stimulus.object == trials[9].stimulus.object;
    CHECK(across > seeds / 5);
}

TEST_CASE("changing one block reshuffles no other", "[unit]") {
    const std::string one = "[[block]]\nid = \"one\"\ntasks = \"free\"\n",
                      two = "[[block]]\nid = \"two\"\ntasks = \"material\"\n";
    const Protocol both = with_blocks(one + two), alone = with_blocks(two), turned = with_blocks(two + one),
                   changed = with_blocks(one + "repetitions = 2\nmax_object_run = 1\n" + two +
                                         "[[block]]\nid = \"three\"\ntasks = \"age\"\n");
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const auto stimuli = [&](const Protocol& protocol, int block) {
            std::vector<Stimulus> list;
            for (const Trial& trial : of_block(make_schedule(protocol, {"P", 3}, seed).trials, block))
                list.push_back(trial.stimulus);
            return list;
        };
        const std::vector<Stimulus> expected = stimuli(both, 1);
        REQUIRE(stimuli(alone, 0) == expected);
        REQUIRE(stimuli(turned, 0) == expected);
        REQUIRE(stimuli(changed, 1) == expected);
    }
}

TEST_CASE("a limit that a block cannot keep to is reported at its line, with what would do", "[unit]") {
    const auto findings = findings_of("[[block]]\nid = \"one\"\ntasks = \"free\"\nmin_object_distance = 4\n");
    REQUIRE(findings.size() == 1);
    CHECK_THAT(findings[0],
               Contains("no order keeps to a distance of 4 between trials with the same object in "
                        "block \"one\": one object has 3 of the 9 trials") &&
                   Contains("a distance of 3 is the most"));
    const ReadText read(
        text_of_file(source_path("protocols/overt_2019.toml")),
        "[[block]]\nid = \"one\"\ntasks = \"free\"\norder = \"sequential\"\nmax_object_run = 2\n");
    REQUIRE(read.diagnostics.findings().size() >= 1);
    CHECK_THAT(read.diagnostics.print(),
               Contains("max_object_run = 2\n") && Contains("allow runs of 3 at least"));
    // Two limits that hold one by one.
    const auto together = findings_of("[[block]]\nid = \"one\"\ntasks = [\"free\", \"material\"]\n"
                                      "objects = [\"muse\", \"runner\"]\nmaterials = \"smooth\"\n"
                                      "max_task_run = 1\nmax_object_run = 1\n");
    REQUIRE_FALSE(together.empty());
    CHECK_THAT(together[0], Contains("runs of 1 with the same task and to runs of 1 with the same object") &&
                                Contains("loosen block[0].max_task_run or block[0].max_object_run"));
}

TEST_CASE("what a block says wrongly is said", "[unit]") {
    const auto first = [](std::string_view block, std::string_view schedule = "") {
        const auto findings = findings_of("[[block]]\nid = \"one\"\n" + std::string(block), schedule);
        return findings.empty() ? std::string() : findings.front();
    };
    CHECK_THAT(first("tasks = [\"fre\"]\n"), Contains("there is no task \"fre\"") && Contains("\"free\""));
    CHECK_THAT(first("tasks = [\"free\", \"free\"]\n"), Contains("listed twice"));
    CHECK_THAT(first("by = \"task\"\n"), Contains("\"by\" is for blocks of order blocked or weighted"));
    CHECK_THAT(first("order = \"weighted\"\nby = \"material\"\nweights = [1, 2]\n"),
               Contains("2 weights for 3 levels of the factor material"));
    CHECK_THAT(first("order = \"weighted\"\nby = \"material\"\nweights = [0.5, 1, 1]\n"),
               Contains("whole numbers"));
    CHECK_THAT(first("order = \"weighted\"\nby = \"material\"\nweights = [0, 0, 0]\n"),
               Contains("nothing would be shown"));
    CHECK_THAT(first("continues = true\n"), Contains("no block before"));
    CHECK_THAT(first("repetitions = 100\n"), Contains("3000 trials; 2000 is the most"));
    CHECK_THAT(first("tasks = []\n"), Contains("the list is empty"));
    CHECK_THAT(
        ReadText(minimal_protocol,
                 "[[task]]\nid = \"idle\"\nquestion = \"?\"\n[[block]]\nid = \"one\"\ntasks = \"free\"\n")
            .diagnostics.print(),
        Contains("p.toml:15:1: warning: no block asks task \"idle\""));
    CHECK_THAT(first("[[block]]\nid = \"one\"\n"), Contains("id \"one\" is taken already"));
    CHECK_THAT(first("[[group]]\nid = \"g\"\ncap = 3\n"),
               Contains("12 observers are planned") && Contains("only 3"));
}

TEST_CASE("a number of observers that does not fill a square is warned of", "[unit]") {
    std::string text = text_of_file(source_path("protocols/overt_2019.toml"));
    text.replace(text.find("observers = 12"), 14, "observers = 9\nmaterial_rotation = \"balanced\"");
    const ReadText read(
        text, "[[block]]\nid = \"one\"\norder = \"blocked\"\nby = \"task\"\nlevels = \"balanced\"\n");
    CHECK_THAT(read.diagnostics.print(),
               Contains("9 observers cannot see 3 materials equally often") &&
                   Contains("6 or 12 observers would") &&
                   Contains("9 observers do not fill the square of levels of block \"one\""));
}

TEST_CASE("a square is filled group by group, by the observers and the levels that the group has", "[unit]") {
    const auto warnings_for = [](int observers, int gold, int coating) {
        std::string text = text_of_file(source_path("protocols/overt_2019.toml"));
        text.replace(text.find("observers = 12"), 14, fmt::format("observers = {}", observers));
        const ReadText read(
            text, fmt::format("[[group]]\nid = \"gold\"\nmaterials = [\"smooth\", \"rough\"]\ncap = {}\n"
                              "[[group]]\nid = \"coating\"\nmaterials = [\"coated\"]\ncap = {}\n",
                              gold, coating));
        CHECK_FALSE(read.diagnostics.has_errors());
        return read.diagnostics.print();
    };
    // The rotation takes two rows of the first group, one of the second.
    CHECK_THAT(warnings_for(10, 6, 4), !Contains("do not fill"));
    CHECK_THAT(warnings_for(11, 6, 5), !Contains("do not fill"));
    CHECK_THAT(
        warnings_for(10, 7, 3),
        Contains("7 observers of group \"gold\" do not fill the rotation of materials, which takes 2") &&
            Contains("6 or 8 observers of group \"gold\" would"));
}
