/// Pairs of levels of made-up studies: what their similarities can be held against.
#include <cmath>
#include <memory>
#include <numeric>

#include <catch2/catch.hpp>

#include "experiment/statistics/permutation.h"
#include "experiment/study/observer_similarities.h"
#include "experiment/study/study_pairs.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

PairRow pair_of(test::PaintedStudy& study) {
    study.options.compare = "material";
    study.options.permutations = std::min(study.options.permutations, 100);
    const auto rows = study_pairs(study.results, study.surfaces, fixation_maps(study.results, study.surfaces),
                                  {}, study.options);
    REQUIRE(rows.size() == 1);
    return rows.front();
}

/// Leaves the first of each trial of one level.
void thin_out(test::PaintedStudy& study, const std::string& level, std::size_t fixations) {
    for (StudyTrial& trial : study.results.trials) {
        if (trial.key("material") == level)
            trial.fixations = fixations;
    }
}

/// Looks at the front. Each trial of `fixations` errs by an amount of its own.
test::PaintedStudy::Look erring(double spread, double error, int fixations) {
    struct State {
        glm::dvec3 error{0.0};
        int looks = 0;
    };
    return [=, state = std::make_shared<State>()](int, int, RandomStream& random) {
        if (state->looks++ % fixations == 0)
            state->error = test::near(glm::dvec3(0.0), error, random);
        return test::near(test::front, spread, random) + state->error;
    };
}

} // namespace

TEST_CASE("where levels make no difference, maps of the same one are as alike as maps of different ones, "
          "whatever their numbers of fixations and the errors of trials",
          "[unit]") {
    std::vector<double> cc, sim;
    double full = 0.0;
    int holding = 0;
    constexpr int studies = 30;
    for (int seed = 1; seed <= studies; ++seed) {
        test::PaintedStudy study(8, 2, 24, erring(0.4, 0.2, 24), static_cast<std::uint64_t>(seed));
        thin_out(study, "rough", 10);
        study.options.permutations = 1;
        const PairRow row = pair_of(study);
        cc.push_back(*row.cc.level_effect.value);
        sim.push_back(*row.sim_mit.level_effect.value);
        full += (*row.sim_mit.value.value - *row.sim_mit.same_level.value) / studies;
        holding += row.cc.level_effect.interval->contains(0.0);
        CHECK(*row.cc.level_effect.value ==
              Approx(*row.cc.same_level.value - *row.cc.other_level.value).margin(1e-12));
    }
    INFO("SIM of all fixations " << full << ", holding " << holding);
    for (const std::vector<double>& effects : {cc, sim}) {
        const double mean = std::accumulate(effects.begin(), effects.end(), 0.0) / studies;
        double squares = 0.0;
        for (const double effect : effects)
            squares += (effect - mean) * (effect - mean);
        const double error = std::sqrt(squares / (studies - 1.0) / studies);
        CAPTURE(mean, error);
        CHECK(std::abs(mean) < 3.5 * error);
        CHECK(error < 0.01);
    }
    // Of 95 %: fewer once in 2,000 such tests.
    CHECK(holding >= 24);
}

TEST_CASE("maps of two observers who saw different levels that differ are less alike", "[unit]") {
    test::PaintedStudy study(6, 2, 20, [](int, int level, RandomStream& random) {
        return test::near(level == 1 && random.uniform() < 0.5 ? test::top : test::front, 0.2, random);
    });
    const PairRow row = pair_of(study);
    CHECK(*row.cc.level_effect.value > 0.1);
    CHECK(row.cc.level_effect.interval->low > 0.0);
    CHECK(*row.sim_mit.level_effect.value > 0.05);
    CHECK(row.sim_mit.level_effect.interval->low > 0.0);
    CHECK(*row.maps_p < 0.05);
}

TEST_CASE(
    "one trial of each level cannot be dealt out again, one observer has nobody to be held against, and "
    "both are said",
    "[unit]") {
    test::PaintedStudy study(
        1, 2, 20, [](int, int, RandomStream& random) { return test::near(test::front, 0.3, random); });
    const PairRow row = pair_of(study);
    CHECK(row.cc.value.value);
    CHECK_FALSE(row.cc.p);
    CHECK(row.cc.null.absent == "one trial of each level: there is nothing to be dealt out again");
    CHECK(row.cc.same_level.absent == "no two observers have maps of both levels on one object");
}

TEST_CASE(
    "where trials err and levels are alike, neither whole maps nor whole trials find more than chance allows",
    "[unit]") {
    int dealing = 0, maps = 0;
    constexpr int studies = 30;
    for (int seed = 1; seed <= studies; ++seed) {
        test::PaintedStudy study(5, 2, 10, erring(0.3, 0.15, 10), static_cast<std::uint64_t>(seed), "rough",
                                 3);
        study.options.permutations = 39; // p of 1/40 and 2/40 are found
        const PairRow row = pair_of(study);
        dealing += *row.cc.p <= 0.05;
        maps += *row.maps_p <= 0.0626; // the least of 2^4 ways: 1 / 16
    }
    INFO(dealing << " and " << maps << " of " << studies);
    // More by chance in one of 3,000 such tests.
    CHECK(dealing <= 6);
    CHECK(maps <= 7);
}

TEST_CASE("p are corrected over the pairs within groups, and apart from these over the pairs of all",
          "[unit]") {
    test::PaintedStudy study(
        6, 2, 12,
        [](int, int level, RandomStream& random) {
            return test::near(level == 1 ? test::top : test::front, 0.6, random);
        },
        1, "rough", 2);
    study.options.compare = "material";
    study.options.by = {"task", "material"};
    study.options.permutations = 50;
    for (std::size_t i = 0; i < study.results.trials.size(); ++i)
        study.results.trials[i].keys.push_back({"task", i % 2 == 0 ? "first" : "second"});
    const auto rows = study_pairs(study.results, study.surfaces, fixation_maps(study.results, study.surfaces),
                                  {}, study.options);
    for (const auto& [p, corrected] : {std::pair(&PairRow::wss_p, &PairRow::wss_p_holm),
                                       std::pair(&PairRow::maps_p, &PairRow::maps_p_holm)}) {
        std::vector<double> of_groups, of_all;
        for (const PairRow& row : rows)
            if (row.*p)
                (row.keys.empty() ? of_all : of_groups).push_back(*(row.*p));
        REQUIRE(of_groups.size() == 2);
        REQUIRE(of_all.size() == 1);
        const std::vector<double> expected = holm(of_groups);
        std::size_t group = 0;
        for (const PairRow& row : rows) {
            REQUIRE((row.*corrected).has_value());
            CHECK(*(row.*corrected) == (row.keys.empty() ? of_all.front() : expected[group++]));
        }
        // Of two that are small, the correction is seen.
        CHECK(expected != of_groups);
    }
}

TEST_CASE("trials of levels that differ are not dealt out so unlike each other by chance", "[unit]") {
    test::PaintedStudy study(
        4, 2, 8,
        [](int, int level, RandomStream& random) {
            return test::near(level == 1 ? test::top : test::front, 0.4, random);
        },
        1, "rough", 3);
    const PairRow row = pair_of(study);
    CHECK(*row.cc.p <= 0.02);
    CHECK(*row.cc.value.value < row.cc.null.interval->low);
    CHECK(*row.sim_pysaliency.p <= 0.02);
}

TEST_CASE(
    "what no frame shows is no part of the maps that are compared, and intervals end where similarities do",
    "[unit]") {
    test::PaintedStudy study(
        6, 2, 20, [](int, int, RandomStream& random) { return test::near(test::front, 0.25, random); });
    const PairRow whole = pair_of(study);
    StudyObject& ball = study.results.objects[0];
    for (std::size_t v = 0; v < ball.seconds_visible.size(); ++v) {
        if (ball.mesh->positions[v].y > -50.0f)
            ball.seconds_visible[v] = 0.0f;
    }
    const PairRow shown = pair_of(study);
    // On the far side both maps are 0, which made them alike.
    CHECK(*shown.cc.value.value < *whole.cc.value.value - 0.02);
    CHECK(*shown.maps_cc < *whole.maps_cc);
    CHECK(whole.cc.value.interval->high <= 1.0);
    CHECK(within(Estimate::of(0.99, Interval{0.97, 1.02}), -1.0).interval->high == 1.0);
    CHECK(within(Estimate::of(0.1, Interval{-0.2, 0.5}), 0.0).interval->low == 0.0);
}
