/// Each trial of a task has places of its probes.
#include "experiment/design/point_trials.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

Protocol with_probes(const std::string& task, const std::string& probes, int count = 6) {
    const ReadText read(minimal_protocol,
                        fmt::format("{}\n{}\n[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n"
                                    "[[points]]\nid = \"seen\"\nevenly = {}\n"
                                    "[[points]]\nid = \"two\"\nplaces = [[1, 0.2, 0.3], [7, 0, 1]]\n",
                                    task, probes, count));
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

const std::string one_probe = "[[task.probe]]\nid = \"place\"\npoints = \"seen\"\n";
const std::string pair_of_probes = one_probe + "[[task.probe]]\nid = \"other\"\npoints = \"seen\"\n";

std::vector<Trial> point_trials_of(const Protocol& protocol, int observer = 1, std::uint64_t seed = 3) {
    return make_schedule(protocol, {"P", observer}, seed).trials;
}

/// The levels of two factors, in the order of their names.
std::pair<std::string, std::string> pair_in(const Trial& trial) {
    const std::string one(own_level(trial, "place")), other(own_level(trial, "other"));
    return std::minmax(one, other);
}

} // namespace

TEST_CASE("each stimulus comes with each place of a probe, as often as the task repeats", "[unit]") {
    const std::vector<Trial> trials = point_trials_of(with_probes("repetitions = 2", one_probe));
    std::map<std::pair<int, std::string>, int> times;
    for (const Trial& trial : trials)
        ++times[{trial.stimulus.material, std::string(own_level(trial, "place"))}];
    CHECK(trials.size() == 2 * 2 * 6);
    CHECK(times.size() == 2 * 6);
    for (const auto& [what, count] : times)
        CHECK(count == 2);
    CHECK(times.contains({0, "seen.1"}));
    CHECK(times.contains({1, "seen.6"}));
}

TEST_CASE("two probes of one list stand at different places, each pair once, sides drawn", "[unit]") {
    const std::vector<Trial> trials = point_trials_of(with_probes("", pair_of_probes));
    std::map<std::pair<int, std::pair<std::string, std::string>>, int> times;
    int rising = 0;
    for (const Trial& trial : trials) {
        CHECK(own_level(trial, "place") != own_level(trial, "other"));
        ++times[{trial.stimulus.material, pair_in(trial)}];
        rising += own_level(trial, "place") < own_level(trial, "other");
    }
    CHECK(trials.size() == 2 * 15);
    CHECK(times.size() == 2 * 15);
    CHECK(rising > 5);
    CHECK(rising < 25);
}

TEST_CASE("probes of two lists are crossed", "[unit]") {
    const std::string probes = one_probe + "[[task.probe]]\nid = \"other\"\npoints = \"two\"\n";
    const Protocol protocol = with_probes("", probes);
    CHECK(point_trials_of(protocol).size() == 2 * 6 * 2);
    CHECK(point_combinations(protocol, protocol.tasks.front(), 1000) == 12);
    CHECK(point_combinations(protocol, protocol.tasks.front(), 10) == 10);
}

TEST_CASE("places are drawn for each observer, the same for all of their stimuli, and again alike",
          "[unit]") {
    const Protocol protocol = with_probes("draw_points = 4", pair_of_probes);
    const auto pairs_of = [&](int observer) {
        std::map<int, std::set<std::pair<std::string, std::string>>> pairs;
        for (const Trial& trial : point_trials_of(protocol, observer))
            pairs[trial.stimulus.material].insert(pair_in(trial));
        return pairs;
    };
    const auto first = pairs_of(1);
    CHECK(first.at(0).size() == 4);
    CHECK(first.at(0) == first.at(1));
    CHECK(first == pairs_of(1));
    std::set<std::set<std::pair<std::string, std::string>>> others;
    for (int observer = 1; observer <= 5; ++observer)
        others.insert(pairs_of(observer).at(0));
    CHECK(others.size() > 2);
}

TEST_CASE("places are a factor of the trial's own, of which orders and tables know", "[unit]") {
    const Protocol protocol = with_probes("", one_probe);
    const Factors factors = factors_of(protocol);
    const Factor* const place = factors.find("place");
    REQUIRE(place);
    CHECK(place->source == Factor::Source::own);
    CHECK(place->levels.size() == 7); // and that of trials without one
    CHECK(place->levels.front().name == "seen.1");
}

TEST_CASE("a stream has one place after the other, and keeps its order", "[unit]") {
    const Protocol protocol =
        with_probes("trials = { rule = \"stream\", of = \"material\", length = 12, repeats = 0.25 }",
                    one_probe + "[[block]]\nid = \"b\"\norder = \"sequential\"\n", 4);
    const std::vector<Trial> trials = point_trials_of(protocol);
    REQUIRE(trials.size() == 12);
    std::map<std::string, int> times;
    for (const Trial& trial : trials)
        ++times[std::string(own_level(trial, "place"))];
    CHECK(times.size() == 4);
    for (const auto& [name, count] : times)
        CHECK(count == 3);
}

TEST_CASE("practice has the first places", "[unit]") {
    const Protocol protocol = with_probes("", pair_of_probes);
    const std::vector<TrialLevel> levels = first_points(protocol, 0);
    REQUIRE(levels.size() == 2);
    CHECK(levels[0].level == "seen.1");
    CHECK(levels[1].level == "seen.2");
}
