/// Psychometric functions psi(x) = gamma + (1 - gamma - lambda) F(x; alpha, beta) by maximum likelihood.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/fits/answer_curve.h"
#include "experiment/statistics/estimate.h"

namespace overt {

/// Answers at a level.
struct LevelCount {
    double level = 0.0;
    double trials = 0.0; ///< above 0
    double yes = 0.0;    ///< of them
};

/// gamma or lambda: held at a value, or free between bounds.
struct Asymptote {
    double value = 0.0; ///< that is held, or that the search begins with
    bool is_free = false;
    double lowest = 0.0, highest = 0.06; ///< of a free one
};

struct PsychometricModel {
    CurveShape shape = CurveShape::logistic;
    Asymptote guess, lapse;
};

/// A parameter with its standard errors: from the second derivatives of the likelihood at the data
/// ("observed") and from their expectation ("expected", what programs for generalised linear models print).
struct FittedParameter {
    double value = 0.0;
    std::optional<double> se_observed = {}, se_expected = {};
    bool is_at_bound = false; ///< a free asymptote at one of its bounds has no standard error
};

struct PsychometricFit {
    PsychometricModel model;
    FittedParameter alpha, beta, guess, lapse; ///< alpha in units of the level, beta per unit (Weibull: none)
    double log_likelihood = 0.0;               ///< without binomial coefficients
    double deviance = 0.0, pearson_x2 = 0.0;
    int degrees = 0; ///< of freedom: levels less free parameters
    /// False where the answers step from one asymptote to the other between two levels, or rise nowhere:
    /// alpha is then the middle of the step, if there is one, and beta means nothing.
    bool has_slope = true;
    std::string note; ///< why something is missing; empty where nothing is

    double share_at(double x) const; ///< psi

    /// The level at which psi has this value, with its standard error by the delta method (observed
    /// information). Nothing outside the asymptotes or without a slope.
    struct Threshold {
        double level = 0.0;
        std::optional<double> se = {};
    };
    std::optional<Threshold> threshold(double psi) const;

    /// Covariance of the straight line's constant and slope, gamma and lambda; rows of what is held are 0.
    std::array<std::array<double, 4>, 4> line_covariance{};
    double line_constant = 0.0, line_slope = 0.0; ///< F at x is that of constant + slope * abscissa
};

/// Counts of the same level may stand apart. Fisher scoring with halved steps on the line's constant and
/// slope, free asymptotes kept in their bounds. Nothing with fewer than two levels.
std::optional<PsychometricFit> fit_psychometric(std::span<const LevelCount> counts,
                                                const PsychometricModel& model);

/// Answers of separate trials, put together by level.
std::vector<LevelCount> counts_by_level(std::span<const LevelCount> trials);

struct PsychometricBootstrap {
    bool is_parametric = true; ///< from the fitted shares; else from the observed ones
    int resamples = 999;       ///< with (B + 1) alpha / 2 whole, percentiles are of the sample
    double confidence = 0.95;
    std::uint64_t seed = 1;
    double psi = 0.75; ///< of the threshold
};

/// Percentile intervals, as drawn: which method, how often, from which seed, and how many of the samples had
/// no slope or no maximum. These are left out.
struct PsychometricIntervals {
    PsychometricBootstrap settings;
    int failures = 0;
    std::optional<Interval> alpha, beta, threshold;
    std::optional<double>
        deviance_limit; ///< below which the deviance of a share `confidence` of samples lies
};
PsychometricIntervals bootstrap_psychometric(std::span<const LevelCount> counts, const PsychometricFit& fit,
                                             const PsychometricBootstrap& settings);

/// The interval of the threshold at psi in which twice the log-likelihood falls by no more than the
/// chi-squared quantile of one degree of freedom: better than the delta method with few trials. Nothing where
/// it is open to one side or there is no slope.
std::optional<Interval> profile_interval(std::span<const LevelCount> counts, const PsychometricFit& fit,
                                         double psi, double confidence);

} // namespace overt
