/// Fits of answers: estimates that other programs agree on, data without a maximum, and truth given back.
#include "experiment/fits/binomial_model.h"
#include "experiment/fits/detection.h"
#include "experiment/fits/difference_scaling.h"
#include "experiment/fits/gauge_relief.h"
#include "experiment/fits/pair_scaling.h"
#include "experiment/fits/psychometric_fit.h"
#include "experiment/fits/rating_scale_fit.h"
#include "experiment/fits/response_time_fit.h"
#include "experiment/proving/coverage_study.h"
#include "experiment/proving/known_answers.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"

using namespace overt;

namespace {

void require_known(const KnownAnswers& answers) {
    REQUIRE_FALSE(answers.empty());
    for (const KnownAnswer& one : answers) {
        INFO(one.what << ": known " << one.known << ", ours " << one.ours);
        CHECK(one.holds());
    }
}

const std::vector<LevelCount> two_alternatives_data{{0.5, 40, 21}, {1, 40, 24}, {1.5, 40, 27}, {2, 40, 31},
                                                    {3, 40, 36},   {4, 40, 38}, {6, 40, 39}};

} // namespace

TEST_CASE("psychometric fits are those of other programs", "[unit]") {
    require_known(known_psychometric_fits());
}
TEST_CASE("scales of differences and pairs are those of other programs", "[unit]") {
    require_known(known_scales());
}
TEST_CASE("d' of all designs is that of other programs", "[unit]") { require_known(known_detection()); }
TEST_CASE("matches and reliefs are those of other programs", "[unit]") { require_known(known_matches()); }

TEST_CASE("answers that step from chance to certainty have no slope", "[unit]") {
    const std::vector<LevelCount> step{{1, 20, 10}, {2, 20, 10}, {3, 20, 20}, {4, 20, 20}};
    const auto fit = fit_psychometric(step, {CurveShape::logistic, {0.5}, {0.0}});
    REQUIRE(fit);
    CHECK_FALSE(fit->has_slope);
    CHECK(fit->alpha.value == 2.5);
    CHECK_FALSE(fit->alpha.se_observed);
    CHECK_FALSE(fit->threshold(0.75));
    CHECK_FALSE(fit->note.empty());
}

TEST_CASE("a bootstrap of a psychometric function is as wide as its reference, and says what failed",
          "[unit]") {
    const auto fit = fit_psychometric(two_alternatives_data, {CurveShape::weibull, {0.5}, {0.02}});
    REQUIRE(fit);
    PsychometricBootstrap settings;
    settings.is_parametric = GENERATE(true, false);
    const PsychometricIntervals found = bootstrap_psychometric(two_alternatives_data, *fit, settings);
    REQUIRE(found.alpha);
    // 20,000 samples gave 1.749 to 2.728 (1.745 to 2.731 nonparametric), blocks of 2000 +- 0.06 and 0.03.
    CHECK(found.alpha->low == Approx(1.747).margin(0.09));
    CHECK(found.alpha->high == Approx(2.729).margin(0.06));
    CHECK(found.settings.resamples == 999);
    CHECK(found.failures < 10);
    if (!settings.is_parametric)
        return;
    CHECK(found.threshold->low == Approx(1.409).margin(0.09));
    CHECK(found.threshold->high == Approx(2.355).margin(0.06));
    CHECK(found.deviance_limit.value() == Approx(11.234).margin(0.9));
}

TEST_CASE("the profile interval holds the threshold and is near the bootstrap's", "[unit]") {
    const auto fit = fit_psychometric(two_alternatives_data, {CurveShape::weibull, {0.5}, {0.02}});
    const auto interval = profile_interval(two_alternatives_data, *fit, 0.75, 0.95);
    REQUIRE(interval);
    CHECK(interval->contains(fit->threshold(0.75)->level));
    CHECK(interval->low == Approx(1.409).margin(0.1));
    CHECK(interval->high == Approx(2.355).margin(0.1));
}

TEST_CASE("separated answers are fitted with a penalty, which is said", "[unit]") {
    // An observer without a single answer against the scale 0, 1, 2, 4.
    const std::vector<DifferenceCount> consistent{
        {{0, 1, 2}, 10, 5}, {{0, 1, 3}, 10, 10}, {{0, 2, 3}, 10, 5}, {{1, 2, 3}, 10, 10}};
    const auto scale = fit_difference_scale(consistent, 4);
    REQUIRE(scale);
    CHECK(scale->is_penalised);
    CHECK(std::isfinite(scale->raw.back()));
    CHECK(std::is_sorted(scale->scale.begin(), scale->scale.end()));
    // One that always wins.
    const std::vector<PairCount> pairs{{0, 1, 10, 0}, {0, 2, 10, 0}, {1, 2, 10, 5}};
    const auto pair_scale = fit_pairs(pairs, 3, PairModel::bradley_terry);
    REQUIRE(pair_scale);
    CHECK(pair_scale->is_penalised);
    CHECK(pair_scale->from_first[1] == Approx(pair_scale->from_first[2]));
    CHECK(pair_scale->from_first[1] > 1.0);
    // The other data have a maximum.
    CHECK_FALSE(fit_pairs(std::vector<PairCount>{{0, 1, 10, 2}}, 2, PairModel::bradley_terry)->is_penalised);
}

TEST_CASE("with Jeffreys' prior a share has the estimate that its closed form says", "[unit]") {
    // One coefficient and the logit: (yes + 1/2) / (n + 1).
    const auto fit = fit_binomial({{{1.0}, 9.0, 9.0}}, BinomialLink::logit);
    REQUIRE(fit);
    CHECK(fit->is_penalised);
    CHECK(share_of_sum(BinomialLink::logit, fit->coefficients[0]) == Approx(9.5 / 10.0));
}

TEST_CASE("a bias to one side is told from the items", "[unit]") {
    constexpr double items[] = {0.0, 0.5, 1.0, 1.5}, side = 0.4;
    std::vector<PairCount> pairs;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            if (i != j)
                pairs.push_back({i, j, 1e6, 1e6 / (1.0 + std::exp(-(items[i] - items[j] + side)))});
    const auto scale = fit_pairs(pairs, 4, PairModel::bradley_terry, true);
    REQUIRE(scale);
    CHECK(scale->side.value() == Approx(side));
    CHECK(scale->from_first[3] == Approx(1.5));
}

TEST_CASE("conjoint measurement gives back what each factor adds", "[unit]") {
    constexpr double gloss[] = {0.0, 0.7, 1.9}, bump[] = {0.0, 0.3};
    std::vector<ConjointCount> counts;
    for (int g = 0; g < 3; ++g)
        for (int b = 0; b < 2; ++b)
            for (int h = 0; h < 3; ++h)
                for (int c = 0; c < 2; ++c) {
                    const double delta = gloss[g] + bump[b] - gloss[h] - bump[c];
                    counts.push_back({{g, b}, {h, c}, 1e6, 1e6 * normal_probability(delta)});
                }
    const int levels[] = {3, 2};
    const auto scale = fit_conjoint(counts, levels);
    REQUIRE(scale);
    CHECK(scale->parts[0][1] == Approx(0.7));
    CHECK(scale->parts[0][2] == Approx(1.9));
    CHECK(scale->parts[1][1] == Approx(0.3));
}

TEST_CASE("the bootstrap of a difference scale is as wide as its reference", "[unit]") {
    std::vector<DifferenceCount> quads;
    const double upper[] = {10, 14, 14, 12, 15, 12, 10, 14, 11, 5, 11, 15, 11, 7, 10};
    std::size_t row = 0;
    for (int a = 0; a < 6; ++a)
        for (int b = a + 1; b < 6; ++b)
            for (int c = b + 1; c < 6; ++c)
                for (int d = c + 1; d < 6; ++d)
                    quads.push_back({{a, b, c, d}, 15, upper[row++]});
    const auto scale = fit_difference_scale(quads, 6);
    const auto intervals = bootstrap_difference_scale(quads, *scale, {999, 0.95, 1});
    REQUIRE(intervals);
    // Of four seeds with 4000 samples each.
    constexpr double sd[] = {0.053, 0.0595, 0.052, 0.0365};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(intervals->scale_sd[i + 1] == Approx(sd[i]).epsilon(0.1));
        CHECK(scale->normalised_se(i + 1).value() == Approx(sd[i]).epsilon(0.15));
    }
    CHECK(intervals->sigma.low == Approx(0.1955).margin(0.02));
    CHECK(intervals->sigma.high == Approx(0.464).margin(0.05));
}

TEST_CASE("d' of a share and its error meet their limits", "[unit]") {
    CHECK(d_prime_of_share(DetectionDesign::alternatives, 0.4, 2) == 0.0);
    CHECK_FALSE(d_prime_of_share(DetectionDesign::oddity, 1.0));
    const auto unbiased = two_alternatives({40, 10, 10, 40}, ShareCorrection::none);
    const auto by_share = estimate_d_prime(DetectionDesign::alternatives, 80, 100, ShareCorrection::none, 2);
    CHECK(unbiased.d_prime == Approx(by_share->d_prime));
    CHECK(unbiased.se.value() == Approx(by_share->se.value()).epsilon(1e-4));
    CHECK(d_prime_same_different(same_different_hits(1.7, 0.15), 0.15).value() == Approx(1.7));
}

TEST_CASE("ratings give back places and cuts", "[unit]") {
    constexpr double places[] = {0.0, 0.8, 2.0}, cuts[] = {-0.5, 0.7, 1.6};
    std::vector<RatingCounts> stimuli;
    for (const double place : places) {
        RatingCounts& one = stimuli.emplace_back();
        double below = 0.0;
        for (const double cut : cuts) {
            const double up_to = normal_probability(cut - place);
            one.by_category.push_back(1e6 * (up_to - below));
            below = up_to;
        }
        one.by_category.push_back(1e6 * (1.0 - below));
    }
    stimuli.front().by_category.insert(stimuli.front().by_category.begin() + 2, 0.0); // never given
    for (std::size_t i = 1; i < 3; ++i)
        stimuli[i].by_category.insert(stimuli[i].by_category.begin() + 2, 0.0);
    const auto scale = fit_rating_scale(stimuli);
    REQUIRE(scale);
    CHECK(scale->categories == std::vector<std::size_t>{0, 1, 3, 4});
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(scale->stimuli[i] == Approx(places[i]).margin(1e-6));
        CHECK(scale->cuts[i] == Approx(cuts[i]).margin(1e-6));
    }
    CHECK(rating_mean({{1, 2, 1}}).mean == 2.0);
    // Nothing in common: no maximum.
    CHECK_FALSE(fit_rating_scale(std::vector<RatingCounts>{{{10, 0}}, {{0, 10}}}));
}

TEST_CASE("response times give back the numbers that they were drawn by", "[unit]") {
    RandomStream random(4, "times");
    std::vector<double> ex, shifted;
    for (int i = 0; i < 4000; ++i) {
        ex.push_back(0.4 + 0.05 * random.normal() + random.exponential(0.15));
        shifted.push_back(0.25 + std::exp(-1.2 + 0.5 * random.normal()));
    }
    const auto ex_fit = fit_ex_gaussian(ex);
    REQUIRE(ex_fit);
    CHECK(ex_fit->mu == Approx(0.4).margin(0.01));
    CHECK(ex_fit->sigma == Approx(0.05).margin(0.008));
    CHECK(ex_fit->tau == Approx(0.15).margin(0.012));
    const auto log_fit = fit_shifted_log_normal(shifted);
    REQUIRE(log_fit);
    CHECK(log_fit->shift == Approx(0.25).margin(0.03));
    CHECK(log_fit->mu == Approx(-1.2).margin(0.1));
    CHECK(log_fit->sigma == Approx(0.5).margin(0.05));
    // The density is one: its integral is 1.
    double sum = 0.0;
    for (double t = -1.0; t < 6.0; t += 0.001)
        sum += 0.001 * std::exp(ex_fit->log_density(t));
    CHECK(sum == Approx(1.0).margin(1e-6));
    CHECK_FALSE(fit_ex_gaussian(std::vector<double>(20, 0.5)));
}

TEST_CASE("a gauge set steeper than has depth is clipped and counted", "[unit]") {
    const std::vector<ReliefNode> nodes{{0, 0}, {1, 0}, {0, 1}};
    const auto relief = gauge_relief(nodes, std::vector<GaugeSetting>{{{0, 1, 2}, 90.0, 180.0}});
    REQUIRE(relief);
    CHECK(relief->clipped == 1);
    CHECK(relief->z[1] - relief->z[0] == Approx(std::tan(85.0 * 3.14159265358979 / 180.0)));
}

TEST_CASE("intervals of simulated observers hold the truth about as often as they say", "[unit]") {
    // Few studies, so that the test is quick: of 40 at 95 % fewer than 33 hold the truth once in a thousand
    // times.
    for (const CoverageStudy& one : coverage_studies(20, 7)) {
        INFO(one.what << ": " << one.held << " of " << one.studies);
        CHECK(one.held >= 16);
        CHECK(std::abs(one.bias) < 1.0);
    }
}
