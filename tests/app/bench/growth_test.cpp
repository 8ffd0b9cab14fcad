/// The table of growth: each command over each size, with its exponents.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/small_experiment.h"

using namespace overt::test;

TEST_CASE("overt bench growth runs each command over each size and gives the exponents", "[session]") {
    const SmallExperiment experiment(Cache::own);
    const ProgramRun run = experiment.overt({"bench", "growth", "--quick", "--json"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    std::map<std::string, double> figures;
    const auto table = nlohmann::json::parse(run.out);
    for (const auto& figure : table.at("figures"))
        figures[figure.at("figure")] = figure.at("value");
    for (const std::string command : {"run", "export", "analyze", "verify", "replay"}) {
        for (const int trials : {2, 4, 6}) {
            CHECK(figures.at(fmt::format("{} over trials, {}: processor", command, trials)) > 0.0);
            CHECK(figures.at(fmt::format("{} over trials, {}: memory", command, trials)) > 1.0);
        }
        CHECK(figures.contains(command + " over trials: exponent of processor time"));
        CHECK(figures.contains(command + " over trials: exponent of memory"));
    }
    for (const std::string command : {"export", "analyze"})
        CHECK(figures.contains(command + " over sessions: exponent of processor time"));
    CHECK(figures.size() == 5 * (3 * 2 + 2) + 2 * (3 * 2 + 2));
}
