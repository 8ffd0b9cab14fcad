/// Effects of factors on trials, in studies with the paper's design whose truth is planted.
#include "experiment/study/factor_effects.h"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/experiment/study/counted_trials.h"

using namespace overt;
using namespace overt::test;

namespace {

const FactorEffectRow& row_of(const std::vector<FactorEffectRow>& rows, const std::string& measure,
                              const std::string& effect) {
    const auto found = std::ranges::find_if(
        rows, [&](const auto& row) { return row.measure == measure && row.effect == effect; });
    REQUIRE(found != rows.end());
    return *found;
}

} // namespace

TEST_CASE("effects that are planted are found, and others are not", "[unit]") {
    // Observers differ from each other and in what a task does to them; material does nothing to the head's
    // share, and spreads fixations.
    CountedTrials study(12, [](const TrialOfDesign& trial, RandomStream& random) {
        RandomStream own(5, "observer's own", static_cast<std::uint64_t>(10 * trial.observer + trial.task));
        const double odds = -1.0 + 0.8 * (trial.task == 1) + 0.4 * own.normal() + 0.5 * trial.object;
        const double spread = std::exp(0.25 * trial.material + 0.1 * own.normal() + 0.1 * random.normal());
        return LooksOfTrial{1.0 / (1.0 + std::exp(-odds)), 20.0 * spread};
    });
    const auto rows = factor_effects(study.results, {}, study.options);
    REQUIRE(rows.size() == 9); // of two areas and of WSS
    CHECK(row_of(rows, "share on head", "task").p < 0.01);
    CHECK(row_of(rows, "share on head", "material").p > 0.05);
    CHECK(row_of(rows, "share on head", "task:material").p > 0.05);
    CHECK(row_of(rows, "log WSS", "task").p > 0.05);
    CHECK(row_of(rows, "log WSS", "material").p < 0.001);
    CHECK(row_of(rows, "log WSS", "task:material").p > 0.05);
    for (const FactorEffectRow& row : rows) {
        CHECK(row.observers == 12);
        CHECK(*row.p_holm >= *row.p);
        CHECK(*row.p >= *row.least_p);
    }
    // The same again, from the same seed.
    CHECK(factor_effects(study.results, {}, study.options)[4].p == rows[4].p);
}

TEST_CASE("an interaction is found that no factor alone shows", "[unit]") {
    CountedTrials study(12, [](const TrialOfDesign& trial, RandomStream&) {
        const double turn = (trial.task % 2 == 0 ? 1.0 : -1.0) * (trial.material - 1);
        return LooksOfTrial{0.5 + 0.25 * turn, 20.0};
    });
    const auto rows = factor_effects(study.results, {}, study.options);
    CHECK(row_of(rows, "share on head", "task:material").p < 0.01);
    CHECK(row_of(rows, "share on head", "material").p > 0.05);
}

TEST_CASE("without an effect of a factor few studies find one, whatever objects and tasks do", "[unit]") {
    // Tasks 3 to 6 are asked once for each object, whose material goes round over the observers. Tasks
    // move the head's share by object, and each observer's tasks and materials their own way: none of
    // this is an effect of material, nor, since these ways are about 0, one of both together. Four
    // observers are no whole number of rounds, so that what objects do has to be taken off.
    constexpr int studies = 100;
    int material = 0, both = 0, task = 0;
    for (int study = 0; study < studies; ++study) {
        CountedTrials one(
            study % 2 == 0 ? 10 : 7,
            [study](const TrialOfDesign& trial, RandomStream&) {
                const auto index = [&](int what) {
                    return static_cast<std::uint64_t>(((study * 50 + trial.observer) * 10 + what) * 2);
                };
                RandomStream of_task(9, "task", index(trial.task)),
                    of_material(9, "material", index(6 + trial.material));
                const double effect = study % 2 == 0 ? 0.9 * trial.task * (trial.object - 1) : 0.0;
                const double odds = -0.5 + effect + 0.5 * of_task.normal() + 0.5 * of_material.normal();
                return LooksOfTrial{1.0 / (1.0 + std::exp(-odds)), 20.0};
            },
            static_cast<std::uint64_t>(100 + study));
        one.options.permutations = 40;
        const auto rows = factor_effects(one.results, {}, one.options);
        material += *row_of(rows, "share on head", "material").p <= 0.05;
        both += *row_of(rows, "share on head", "task:material").p <= 0.05;
        task += study % 2 != 0 && *row_of(rows, "share on head", "task").p <= 0.05;
    }
    // Binomial with 5 % of 100 (of 50 for the task): no more than 13 (9) with probability 0.999.
    CHECK(material <= 13);
    CHECK(both <= 13);
    CHECK(task <= 9);
}

TEST_CASE("where an effect cannot be tested the row says why", "[unit]") {
    const auto same = [](const TrialOfDesign&, RandomStream&) { return LooksOfTrial{0.5, 20.0}; };
    CountedTrials study(3, same);
    // Each trial is the only one with its number, task and material.
    study.options.by = {"task", "trial", "hand"};
    for (StudyTrial& trial : study.results.trials) {
        trial.keys.push_back({"trial", std::to_string(trial.number)});
        trial.keys.push_back({"hand", trial.session == 0 ? "left" : "right"});
    }
    const auto rows = factor_effects(study.results, {}, study.options);
    CHECK(row_of(rows, "share on head", "hand").absent ==
          "fewer than two observers have numbers in two levels");
    CHECK(row_of(rows, "share on head", "task:hand").absent ==
          "fewer than two observers have numbers that tell it from both by themselves");
    study.options.by = {"task", "unknown"};
    const auto others = factor_effects(study.results, {}, study.options);
    CHECK(row_of(others, "log WSS", "unknown").absent == "there is one level alone");
    CHECK(row_of(others, "log WSS", "task:unknown").absent == "one of both has one level alone");
    // An object without a head has no share of it.
    for (StudyObject& object : study.results.objects)
        object.areas = Areas();
    const auto headless = factor_effects(study.results, {}, study.options);
    CHECK(row_of(headless, "share on head", "task").absent ==
          "no two levels were measured with all else alike");
    CHECK(row_of(headless, "log WSS", "task").p);
}
