/// Scales from judgements of differences: maximum likelihood difference scaling (MLDS; Maloney and Yang,
/// Journal of Vision 3(8):5, 2003) of triads and quadruples, and conjoint measurement (MLCM; Ho, Landy and
/// Maloney, Psychological Science 19, 2008), as generalised linear models with the probit link (Knoblauch and
/// Maloney, Journal of Statistical Software 25(2), 2008).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/fits/binomial_model.h"
#include "experiment/statistics/estimate.h"

namespace overt {

/// Answers to a triad a < b < c (three places) or a quadruple a < b < c < d (four), places on the series from
/// 0. `upper` counts answers that the upper pair, (b, c) or (c, d), differs more: sides and reversed orders
/// are undone.
struct DifferenceCount {
    std::vector<int> places;
    double trials = 0.0, upper = 0.0;
};

struct DifferenceScale {
    std::vector<double> raw; ///< by level: 0 for the first, in standard deviations of the judgement's noise
    std::vector<double> raw_se; ///< of each; 0 for the first
    std::vector<double> scale;  ///< the same divided by the last: from 0 to 1
    double sigma = 0.0;         ///< noise in units of that scale
    double log_likelihood = 0.0, deviance = 0.0;
    bool is_penalised = false; ///< separated answers: see BinomialFit
    BinomialFit fit;

    /// Of `scale`, by the delta method; 0 for the first and the last. Nothing where the last is not above 0.
    std::optional<double> normalised_se(std::size_t level) const;
};

/// Nothing where the judgements do not reach all `levels` (at least 3), or cannot tell them apart.
std::optional<DifferenceScale> fit_difference_scale(std::span<const DifferenceCount> counts, int levels);

struct ScaleBootstrap {
    int resamples = 999;
    double confidence = 0.95;
    std::uint64_t seed = 1;
};

/// Parametric: answers drawn from the fitted probabilities, fitted and divided by their last value again.
/// Percentiles. How many samples had to be penalised is said, since their scale is drawn together.
struct ScaleIntervals {
    std::vector<Interval> scale; ///< by level; of the first and the last without width
    std::vector<double> scale_sd;
    Interval sigma;
    int penalised = 0, failures = 0;
};
std::optional<ScaleIntervals> bootstrap_difference_scale(std::span<const DifferenceCount> counts,
                                                         const DifferenceScale& scale,
                                                         const ScaleBootstrap& settings);

/// Answers to pairs of stimuli that each have a level in several factors: `first` counts answers that the
/// first has more of what was asked.
struct ConjointCount {
    std::vector<int> first_levels, second_levels; ///< by factor, from 0
    double trials = 0.0, first = 0.0;
};

/// What each level of each factor adds, in standard deviations of the judgement's noise: 0 for the first
/// level of each factor (the additive model).
struct ConjointScale {
    std::vector<std::vector<double>> parts, parts_se; ///< by factor and level
    double log_likelihood = 0.0, deviance = 0.0;
    int degrees = 0;
    bool is_penalised = false;
};
std::optional<ConjointScale> fit_conjoint(std::span<const ConjointCount> counts,
                                          std::span<const int> levels_of_factor);

} // namespace overt
