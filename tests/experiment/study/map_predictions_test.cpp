/// Prediction and reliability of maps whose truth is painted.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/study/map_predictions.h"
#include "experiment/study/map_reliability.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

const MapPredictionRow& row_of(const std::vector<MapPredictionRow>& rows, int group, MapPredictor by) {
    return *std::ranges::find_if(rows, [&](const auto& row) { return row.group == group && row.by == by; });
}

} // namespace

TEST_CASE("fixations are told by the map of their own level, not by that of another place", "[unit]") {
    // Both levels have a place of their own, on opposite sides of the ball.
    const test::PaintedStudy study(6, 2, 12, [](int, int level, RandomStream& random) {
        return test::near(level == 0 ? test::front : test::back, 0.15, random);
    });
    const auto maps = fixation_maps(study.results, study.surfaces);
    const auto rows = map_predictions(study.results, maps, study.options);
    REQUIRE(rows.size() == 6); // two groups by three predictors
    for (int group = 0; group < 2; ++group) {
        const auto &same = row_of(rows, group, MapPredictor::same_level),
                   &other = row_of(rows, group, MapPredictor::other_level),
                   &exposure = row_of(rows, group, MapPredictor::exposure);
        CHECK(same.observers == 6);
        CHECK(*same.auc_judd.value > 0.95);
        CHECK(*same.nss.value > 2.0);
        CHECK(*other.nss.value < 0.0);
        CHECK(*other.auc_judd.value < 0.6);
        CHECK(*same.kl.value < *exposure.kl.value);
        CHECK(*exposure.kl.value < *other.kl.value);
        // A constant map tells nothing: the exposure of this ball is the same everywhere.
        CHECK(!exposure.nss.value);
        CHECK(!exposure.gain_over_exposure.value);
        CHECK(exposure.gain_over_exposure.absent == "the exposure is the baseline itself");
        CHECK(*exposure.gain_over_area.value == Approx(0.0).margin(1e-9));
        CHECK(*same.gain_over_exposure.value == Approx(*same.gain_over_area.value).margin(1e-9));
        CHECK(*same.gain_over_exposure.value > 2.0);
        CHECK(*other.gain_over_exposure.value < 0.0);
        // The exposure, mixed in as one fixation of 61, bounds what a fixation elsewhere can cost.
        CHECK(*other.gain_over_exposure.value > -std::log2(62.0));
    }
    CHECK(row_of(rows, 0, MapPredictor::other_level).level == study.results.groups[1].keys[0].value);
}

TEST_CASE("what could never be seen is no part of what maps are told from", "[unit]") {
    test::PaintedStudy study(
        4, 1, 10, [](int, int, RandomStream& random) { return test::near(test::front, 0.3, random); });
    const auto auc = [&] {
        const auto maps = fixation_maps(study.results, study.surfaces);
        const auto rows = map_predictions(study.results, maps, study.options);
        return std::pair(*row_of(rows, 0, MapPredictor::same_level).auc_judd.value,
                         *row_of(rows, 0, MapPredictor::same_level).gain_over_area.value);
    };
    const auto [auc_whole, gain_whole] = auc();
    StudyObject& ball = study.results.objects[0];
    for (std::size_t v = 0; v < ball.seconds_visible.size(); ++v) {
        if (ball.mesh->positions[v].y > 0.0f)
            ball.seconds_visible[v] = ball.exposure_density[v] = 0.0f;
    }
    const auto [auc_half, gain_half] = auc();
    // The hidden half was easily told from the fixations: one bit, and half of the area that is not fixated.
    CHECK(auc_half < auc_whole - 0.02);
    CHECK(gain_half == Approx(gain_whole - 1.0).margin(0.1));
}

TEST_CASE("one observer alone has no map that others made, and says so", "[unit]") {
    const test::PaintedStudy study(
        1, 2, 5, [](int, int, RandomStream& random) { return test::near(test::top, 0.3, random); });
    const auto maps = fixation_maps(study.results, study.surfaces);
    const auto rows = map_predictions(study.results, maps, study.options);
    const auto& same = row_of(rows, 0, MapPredictor::same_level);
    CHECK(!same.nss.value);
    CHECK(same.nss.absent == "no other observer has fixations there");
    CHECK(row_of(rows, 0, MapPredictor::exposure).kl.value);
    const auto reliabilities = map_reliabilities(study.results, maps, {}, study.options);
    CHECK(reliabilities.front().reliability.absent == "halves need two observers with fixations");
}

TEST_CASE("halves of like-minded observers agree, those of others do not", "[unit]") {
    const auto reliability = [](const test::PaintedStudy::Look& look) {
        const test::PaintedStudy study(8, 1, 20, look);
        const auto maps = fixation_maps(study.results, study.surfaces);
        const auto rows = map_reliabilities(study.results, maps, {}, study.options);
        REQUIRE(rows.size() == 2); // the group, and all together
        CHECK(*rows[0].reliability.value == Approx(*rows[1].reliability.value).margin(1e-12));
        const double r = *rows[0].split_half_cc.value;
        CHECK(*rows[0].reliability.value == Approx(2.0 * r / (1.0 + r)).margin(1e-12));
        REQUIRE(rows[0].reliability.interval);
        CHECK(rows[0].reliability.interval->contains(*rows[0].reliability.value));
        return *rows[0].reliability.value;
    };
    CHECK(reliability([](int, int, RandomStream& random) { return test::near(test::front, 0.2, random); }) >
          0.9);
    CHECK(reliability([](int observer, int, RandomStream& random) {
              const double turn = 0.785 * observer;
              return test::near({std::cos(turn), std::sin(turn), 0.0}, 0.1, random);
          }) < 0.3);
}

TEST_CASE("intervals of predictions hold the truth, for the observers who predict vary, too", "[unit]") {
    // Observers look at places of their own about the front: who predicts matters as much as who is told.
    constexpr int studies = 40;
    std::vector<MapPredictionRow> rows;
    for (int seed = 1; seed <= studies; ++seed) {
        test::PaintedStudy study(
            6, 1, 8,
            [seed](int observer, int, RandomStream& random) {
                RandomStream own(static_cast<std::uint64_t>(seed), "own place",
                                 static_cast<std::uint64_t>(observer));
                return test::near(test::near(test::front, 0.4, own), 0.2, random);
            },
            static_cast<std::uint64_t>(seed));
        study.options.resamples = 50;
        const auto maps = fixation_maps(study.results, study.surfaces);
        rows.push_back(
            row_of(map_predictions(study.results, maps, study.options), 0, MapPredictor::same_level));
    }
    for (const auto member :
         {&MapPredictionRow::gain_over_exposure, &MapPredictionRow::nss, &MapPredictionRow::kl}) {
        double truth = 0.0;
        int holding = 0;
        for (const MapPredictionRow& row : rows)
            truth += *(row.*member).value / studies;
        for (const MapPredictionRow& row : rows)
            holding += (row.*member).interval->contains(truth);
        CAPTURE(truth, holding);
        // Binomial with 95 % of 40: no fewer than 33 with probability 0.999.
        CHECK(holding >= 33);
    }
}
