/// Ratings on a scale of categories: where stimuli lie on a continuous quality, and where it is cut into the
/// categories (Thurstone's law of categorical judgement with equal noise; the cumulative probit model).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// How often each category was given to a stimulus, from the lowest category up.
struct RatingCounts {
    std::vector<double> by_category; ///< as many for all stimuli, at least two
};

struct RatingMean {
    double mean = 0.0;             ///< of the categories' numbers, from 1
    std::optional<double> sd = {}; ///< n - 1
    double count = 0.0;
};
RatingMean rating_mean(const RatingCounts& counts);

struct RatingScale {
    std::vector<double> stimuli, stimuli_se; ///< in standard deviations of the judgement; the first is 0
    std::vector<std::size_t> categories;     ///< that were given at all, from 0, rising
    std::vector<double> cuts, cuts_se;       ///< between each of these and the next, rising
    double log_likelihood = 0.0;
};

/// By maximum likelihood. Nothing with fewer than two categories given, or where the likelihood has no
/// maximum: stimuli that share no category with others.
std::optional<RatingScale> fit_rating_scale(std::span<const RatingCounts> stimuli);

} // namespace overt
