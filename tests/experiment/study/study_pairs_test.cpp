/// Pairs of levels of made-up studies: what their similarities can be held against.
#include <map>
#include <utility>

#include <catch2/catch.hpp>

#include "experiment/study/study_pairs.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

PairRow pair_of(test::PaintedStudy& study) {
    study.options.compare = "material";
    study.options.permutations = 100;
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

} // namespace

TEST_CASE(
    "halves of two levels that are alike are as similar as halves of one, whatever the levels' numbers of "
    "fixations",
    "[unit]") {
    // Over many studies, so that what is left is no chance: three standard errors are 0.01.
    double cc = 0.0, sim = 0.0, full = 0.0;
    constexpr int studies = 12;
    for (int seed = 1; seed <= studies; ++seed) {
        test::PaintedStudy study(
            6, 2, 40, [](int, int, RandomStream& random) { return test::near(test::front, 0.5, random); },
            static_cast<std::uint64_t>(seed));
        thin_out(study, "rough", 16);
        const PairRow row = pair_of(study);
        cc += (*row.cc.between_halves.value - *row.cc.within_halves.value) / studies;
        sim += (*row.sim_mit.between_halves.value - *row.sim_mit.within_halves.value) / studies;
        full += (*row.sim_mit.value.value - *row.sim_mit.within_halves.value) / studies;
    }
    INFO("CC " << cc << ", SIM " << sim << ", SIM of all fixations " << full);
    CHECK(std::abs(cc) < 0.02);
    CHECK(std::abs(sim) < 0.02);
    // All fixations have another similarity, which therefore is not held against halves.
    CHECK(full > 0.05);
}

TEST_CASE("halves of two levels that differ are less similar than halves of one", "[unit]") {
    test::PaintedStudy study(6, 2, 20, [](int, int level, RandomStream& random) {
        return test::near(level == 1 && random.uniform() < 0.5 ? test::top : test::front, 0.2, random);
    });
    const PairRow row = pair_of(study);
    CHECK(*row.cc.between_halves.value < *row.cc.within_halves.value - 0.1);
    CHECK(*row.sim_mit.between_halves.value < *row.sim_mit.within_halves.value - 0.05);
    CHECK(*row.maps_p < 0.05);
}

TEST_CASE("levels with fewer than four fixations have no halves, and it is said", "[unit]") {
    test::PaintedStudy study(
        4, 2, 20, [](int, int, RandomStream& random) { return test::near(test::front, 0.3, random); });
    thin_out(study, "rough", 3);
    const PairRow row = pair_of(study);
    CHECK(row.cc.value.value);
    CHECK_FALSE(row.cc.within_halves.value);
    CHECK(row.cc.between_halves.absent == "no observer has four fixations in both levels");
}

TEST_CASE(
    "where trials err and levels are alike, the test of whole maps finds no more than chance allows, and "
    "the exchange of fixations does",
    "[unit]") {
    int exchange = 0, maps = 0;
    double within_less_between = 0.0;
    constexpr int studies = 24;
    for (int seed = 1; seed <= studies; ++seed) {
        std::map<std::pair<int, int>, glm::dvec3> errors; // of an observer's only trial of a level
        test::PaintedStudy study(
            8, 2, 16,
            [&](int observer, int level, RandomStream& random) {
                const auto [error, is_new] = errors.try_emplace({observer, level}, 0.0);
                if (is_new)
                    error->second = test::near(glm::dvec3(0.0), 0.15, random);
                return test::near(test::front, 0.3, random) + error->second;
            },
            static_cast<std::uint64_t>(seed));
        study.options.splits = 5;
        const PairRow row = pair_of(study);
        exchange += *row.cc.p <= 0.05;
        maps += *row.maps_p <= 0.05;
        within_less_between += (*row.cc.within_halves.value - *row.cc.between_halves.value) / studies;
    }
    INFO(exchange << " and " << maps << " of " << studies);
    CHECK(maps <= 6); // more by chance in one of 7,000 such tests
    // Which is why the report shows no p of exchanged fixations, and draws nothing from the two halves.
    CHECK(exchange > studies / 2);
    CHECK(within_less_between > 0.0);
}
