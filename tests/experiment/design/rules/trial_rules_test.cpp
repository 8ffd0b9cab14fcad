#include "experiment/design/rules/trial_rules.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace overt;

namespace {

int choose(int n, int k) {
    int ways = 1;
    for (int i = 1; i <= k; ++i)
        ways = ways * (n - k + i) / i;
    return ways;
}

/// Levels l0, l1, … of one factor in each of some contexts: stimulus = context * levels + level.
RuleRequest request_of(int levels, int contexts, std::vector<std::string> slots) {
    RuleRequest request;
    request.stimuli = levels * contexts;
    RuleFactor factor{"gloss", {}, {}};
    for (int level = 0; level < levels; ++level)
        factor.levels.push_back(fmt::format("l{}", level));
    for (int stimulus = 0; stimulus < request.stimuli; ++stimulus) {
        request.context.push_back(stimulus / levels);
        factor.of_stimulus.push_back(stimulus % levels);
    }
    request.of = {factor};
    request.slots = std::move(slots);
    return request;
}

const TrialRuleRow& rule_called(std::string_view name) {
    return *std::ranges::find(kinds_of<TrialRuleKind>, name, &TrialRuleRow::name);
}

std::vector<RuledTrial> trials_by(std::string_view rule, const RuleRequest& request, std::uint64_t seed = 1) {
    const auto made = rule_called(rule).make(request);
    CHECK(made->problems().empty());
    RandomStream random(seed, "rule");
    std::vector<RuledTrial> trials = made->trials(random);
    CHECK(trials.size() == made->count());
    for (const RuledTrial& trial : trials)
        REQUIRE(trial.shown.size() == request.slots.size());
    return trials;
}

int count_by(std::string_view rule, const RuleRequest& request) {
    return static_cast<int>(trials_by(rule, request).size());
}

/// What is shown, whatever the slots.
std::set<std::multiset<int>> sets_of(const std::vector<RuledTrial>& trials) {
    std::set<std::multiset<int>> sets;
    for (const RuledTrial& trial : trials)
        sets.insert({trial.shown.begin(), trial.shown.end()});
    return sets;
}

std::vector<std::string> slots_of(int count) {
    std::vector<std::string> slots;
    for (int i = 0; i < count; ++i)
        slots.push_back(fmt::format("s{}", i));
    return slots;
}

std::vector<std::string_view> keys_of_problems(std::string_view rule, const RuleRequest& request) {
    std::vector<std::string_view> keys;
    for (const RuleProblem& problem : rule_called(rule).make(request)->problems())
        keys.push_back(problem.key);
    return keys;
}

} // namespace

TEST_CASE("each rule gives as many trials as its formula says", "[unit]") {
    for (int n = 1; n <= 9; ++n) {
        for (const int contexts : {1, 3}) {
            const auto expect = [&](std::string_view rule, RuleRequest request, int count) {
                INFO(rule << " of " << n << " levels in " << contexts << " contexts");
                for (const auto& [side, ways] :
                     {std::pair(SideRule::drawn, 1), std::pair(SideRule::fixed, 1)}) {
                    request.side = side;
                    CHECK(count_by(rule, request) == count * contexts * ways);
                    CHECK(sets_of(trials_by(rule, request)).size() <=
                          static_cast<std::size_t>(count * contexts));
                }
                request.repetitions = 3;
                CHECK(count_by(rule, request) == 3 * count * contexts);
            };
            const auto crossed = [&](std::string_view rule, RuleRequest request, int count) {
                request.side = SideRule::crossed;
                CHECK(count_by(rule, request) == count * contexts);
            };
            const RuleRequest one = request_of(n, contexts, slots_of(1)),
                              two = request_of(n, contexts, slots_of(2)),
                              three = request_of(n, contexts, slots_of(3)),
                              four = request_of(n, contexts, slots_of(4));
            expect("every", one, n);
            expect("pairs", two, choose(n, 2));
            crossed("pairs", two, n * (n - 1));
            RuleRequest with = two;
            with.with_identical = true;
            expect("pairs", with, choose(n, 2) + n);
            with.is_ordered = true;
            expect("pairs", with, n * n);
            with.with_identical = false;
            expect("pairs", with, n * (n - 1));
            expect("triads", three, choose(n, 3));
            crossed("triads", three, 2 * choose(n, 3));
            expect("quadruples", four, choose(n, 4));
            crossed("quadruples", four, 2 * choose(n, 4));
            expect("tuples", three, choose(n, 3));
            crossed("tuples", three, 6 * choose(n, 3));
            RuleRequest standard = two;
            standard.standards = {"l0"};
            expect("standard", standard, n - 1);
            standard.with_identical = true;
            expect("standard", standard, n);
        }
    }
}

TEST_CASE("triads and quadruples are as many as the tables of difference scaling have", "[unit]") {
    // Stimuli, triads, quadruples that do not overlap.
    for (const auto& [n, triads, quadruples] :
         {std::tuple(5, 10, 5), std::tuple(7, 35, 35), std::tuple(10, 120, 210), std::tuple(12, 220, 495)}) {
        CHECK(count_by("triads", request_of(n, 1, slots_of(3))) == triads);
        CHECK(count_by("quadruples", request_of(n, 1, slots_of(4))) == quadruples);
    }
}

TEST_CASE("the two pairs of a quadruple do not overlap, whichever way they are shown", "[unit]") {
    std::set<std::vector<int>> ways;
    for (const RuledTrial& trial : trials_by("quadruples", request_of(10, 1, slots_of(4)))) {
        const auto [a, b] = std::minmax(trial.shown[0], trial.shown[1]);
        const auto [c, d] = std::minmax(trial.shown[2], trial.shown[3]);
        REQUIRE((b < c || d < a));
        // The side is that of the lower pair.
        REQUIRE(trial.side == (b < c ? 0 : 2));
        ways.insert({trial.shown[0] < trial.shown[1], trial.shown[2] < trial.shown[3], b < c});
    }
    CHECK(ways.size() == 8);
}

TEST_CASE("the middle of a triad is in the middle slot", "[unit]") {
    for (const RuledTrial& trial : trials_by("triads", request_of(6, 2, slots_of(3)))) {
        const int low = std::min(trial.shown[0], trial.shown[2]),
                  high = std::max(trial.shown[0], trial.shown[2]);
        REQUIRE((low < trial.shown[1] && trial.shown[1] < high));
        REQUIRE(trial.shown[static_cast<std::size_t>(*trial.side)] == low);
    }
}

TEST_CASE("sides that are drawn come equally often, and within the repetitions of a pair, too", "[unit]") {
    RuleRequest request = request_of(5, 2, slots_of(2));
    request.repetitions = 4;
    std::set<std::vector<int>> first_sides;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::map<std::multiset<int>, int> on_first;
        std::vector<int> sides;
        for (const RuledTrial& trial : trials_by("pairs", request, seed)) {
            on_first[{trial.shown.begin(), trial.shown.end()}] += *trial.side == 0;
            sides.push_back(*trial.side);
        }
        REQUIRE(on_first.size() == 20);
        for (const auto& [pair, count] : on_first)
            REQUIRE(count == 2);
        sides.resize(20);
        CHECK(std::ranges::count(sides, 0) == 10);
        first_sides.insert(sides);
    }
    CHECK(first_sides.size() == 20);
}

TEST_CASE("a drawn subset has no trial twice, is another for each seed, and reaches all", "[unit]") {
    RuleRequest request = request_of(30, 1, slots_of(3));
    request.draw = 180;
    std::set<std::multiset<int>> met;
    std::map<int, int> often;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const auto sets = sets_of(trials_by("tuples", request, seed));
        REQUIRE(sets.size() == 180);
        for (const auto& set : sets) {
            met.insert(set);
            for (const int member : set)
                ++often[member];
        }
    }
    // 60 * 180 draws of 4060: (1 - 180/4060)^60 of them are met by none.
    CHECK(met.size() > 3500);
    // Each stimulus is in 60 * 180 * 3 / 30 = 1080 of them, give or take.
    for (const auto& [member, count] : often)
        CHECK(std::abs(count - 1080) < 160);
}

TEST_CASE("pairs may differ in one factor and in another besides", "[unit]") {
    // 7 levels of gloss under 3 lights, all in one context: 7 x 7 for each pair of lights.
    RuleRequest request = request_of(7, 3, slots_of(2));
    RuleFactor light{"light", {"a", "b", "c"}, request.context};
    request.context.assign(21, 0);
    RuleRequest by_light = request;
    by_light.of = {light};
    CHECK(count_by("pairs", by_light) == 49 * 3);
    RuleRequest by_both = request;
    by_both.differs = {light};
    CHECK(count_by("pairs", by_both) == (49 - 7) * 3);
}

TEST_CASE("stimuli without a level of the factor take part in nothing", "[unit]") {
    RuleRequest request = request_of(5, 1, slots_of(2));
    request.of.front().of_stimulus[2] = -1;
    CHECK(count_by("pairs", request) == 6);
}

TEST_CASE("a search has each set size with and without its target, by the share", "[unit]") {
    RuleRequest request = request_of(4, 2, slots_of(8));
    request.targets = {"l0"};
    request.distractors = {"l1", "l2"};
    request.set_sizes = {1, 4, 8};
    request.absent = 0.25;
    std::map<std::pair<std::string, std::string>, int> cells;
    std::set<int> places;
    for (const RuledTrial& trial : trials_by("search", request)) {
        const auto shown = std::ranges::count_if(trial.shown, [](int stimulus) { return stimulus >= 0; });
        const auto targets = std::ranges::count_if(
            trial.shown, [](int stimulus) { return stimulus >= 0 && stimulus % 4 == 0; });
        std::set<int> contexts;
        std::map<int, int> kinds;
        for (const int stimulus : trial.shown) {
            if (stimulus < 0)
                continue;
            contexts.insert(stimulus / 4);
            ++kinds[stimulus % 4];
        }
        REQUIRE(contexts.size() == 1);
        REQUIRE_FALSE(kinds.contains(3));
        REQUIRE(std::abs(kinds[1] - kinds[2]) <= 1);
        REQUIRE(trial.levels[0] == std::pair(std::string("set_size"), fmt::format("{}", shown)));
        REQUIRE(targets == (trial.correct == "present" ? 1 : 0));
        REQUIRE(trial.side.has_value() == (targets == 1));
        if (trial.side)
            REQUIRE(trial.shown[static_cast<std::size_t>(*trial.side)] % 4 == 0);
        ++cells[{trial.levels[0].second, trial.correct}];
    }
    CHECK(cells.size() == 6);
    for (const auto& [cell, count] : cells)
        CHECK(count == 2 * (cell.second == "present" ? 3 : 1));
    request.side = SideRule::crossed;
    CHECK(count_by("search", request) == 2 * 3 * 4 * 8);
}

TEST_CASE("a match is like the sample but under another light, and its neighbours are not", "[unit]") {
    // 4 materials under 3 lights.
    RuleRequest request = request_of(4, 3, {"centre", "left", "right"});
    RuleFactor light{"light", {"a", "b", "c"}, request.context};
    request.context.assign(12, 0);
    request.differs = {light};
    request.sample = "centre";
    request.among = {"left", "right"};
    request.side = SideRule::crossed;
    const std::vector<RuledTrial> trials = trials_by("match", request);
    // Sample, another light, another material, two sides.
    CHECK(trials.size() == 4 * 3 * 2 * 3 * 2);
    for (const RuledTrial& trial : trials) {
        const int sample = trial.shown[0], match = trial.shown[static_cast<std::size_t>(*trial.side)],
                  other = trial.shown[static_cast<std::size_t>(3 - *trial.side)];
        REQUIRE(match % 4 == sample % 4);
        REQUIRE(match / 4 != sample / 4);
        REQUIRE(other % 4 != sample % 4);
        REQUIRE(other / 4 == match / 4);
        REQUIRE(trial.correct == request.slots[static_cast<std::size_t>(*trial.side)]);
    }
}

TEST_CASE("a stream repeats what came n before in exactly its share, and nowhere else", "[unit]") {
    RuleRequest request = request_of(5, 2, slots_of(1));
    request.length = 62;
    request.back = 2;
    request.repeats = 0.25;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<RuledTrial> trials = trials_by("stream", request, seed);
        REQUIRE(trials.size() == 124);
        int repeats = 0;
        for (std::size_t i = 0; i < 62; ++i) {
            const bool does_repeat = i >= 2 && trials[i].shown == trials[i - 2].shown;
            REQUIRE(trials[i].correct == (does_repeat ? "repeat" : "new"));
            repeats += does_repeat;
        }
        CHECK(repeats == 15);
    }
}

TEST_CASE("lures of a stream are those that the factor names, as many as were asked for", "[unit]") {
    RuleRequest request = request_of(8, 1, slots_of(1));
    request.length = 62;
    request.back = 2;
    request.repeats = 0.25;
    request.lures = 0.2;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<RuledTrial> trials = trials_by("stream", request, seed);
        int lures = 0, repeats = 0;
        for (std::size_t i = 0; i < trials.size(); ++i) {
            const auto came = [&](std::size_t before) {
                return i >= before && trials[i].shown == trials[i - before].shown;
            };
            const bool is_lure = !came(2) && (came(1) || came(3));
            REQUIRE(trials[i].levels ==
                    std::vector<std::pair<std::string, std::string>>{{"lure", is_lure ? "lure" : "none"}});
            REQUIRE(trials[i].correct == (came(2) ? "repeat" : "new"));
            lures += is_lure;
            repeats += came(2);
        }
        CHECK(repeats == 15);
        CHECK(lures == 12);
    }
    CHECK(keys_of_problems("stream", [&] {
              RuleRequest three = request_of(3, 1, slots_of(1));
              three.length = 62;
              three.lures = 0.9;
              return three;
          }()) == std::vector<std::string_view>{"lures", "lures"});
}

TEST_CASE("what a rule cannot do is said of the key that asks for it", "[unit]") {
    using Keys = std::vector<std::string_view>;
    CHECK(keys_of_problems("pairs", request_of(3, 1, slots_of(3))) == Keys{"rule"});
    CHECK(keys_of_problems("quadruples", request_of(3, 1, slots_of(2))) == Keys{"rule"});
    RuleRequest request = request_of(3, 1, slots_of(2));
    CHECK(keys_of_problems("standard", request) == Keys{"standard"});
    request.standards = {"l7"};
    CHECK(keys_of_problems("standard", request) == Keys{"standard"});
    request.is_ordered = true;
    request.side = SideRule::crossed;
    CHECK(keys_of_problems("pairs", request) == Keys{"side"});
    request.of.push_back(request.of.front());
    CHECK(keys_of_problems("triads", request) == Keys{"rule", "of"});
    RuleRequest search = request_of(3, 1, slots_of(4));
    search.targets = {"l0", "l9"};
    search.distractors = {"l0"};
    search.set_sizes = {5};
    search.absent = 0.123;
    CHECK(keys_of_problems("search", search) == Keys{"target", "distractors", "set_sizes", "absent"});
    RuleRequest match = request_of(3, 1, slots_of(2));
    CHECK(keys_of_problems("match", match) == Keys{"rule"});
    match.sample = "nowhere";
    match.among = {"s0", "there"};
    CHECK(keys_of_problems("match", match) == Keys{"sample", "among"});
    CHECK(keys_of_problems("stream", request_of(3, 1, slots_of(1))) == Keys{"rule"});
}
