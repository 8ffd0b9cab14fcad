/// How well a map of several observers would come out again with as many others.
#pragma once

#include <span>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

struct MapAgreement {
    /// Of the sum of all observers' maps: Cronbach's alpha (Psychometrika 16, 1951), n / (n - 1) times the
    /// share of the variance of the sum over the surface that is covariance of different observers. It is the
    /// mean over all ways to part an even number of observers into halves of what these say (Flanagan's and
    /// Rulon's coefficients), so that nothing has to be drawn.
    Estimate reliability;
    /// The correlation of two halves that has this reliability after Spearman and Brown: alpha / (2 - alpha).
    Estimate of_halves;
};

/// `of_observers`: a map of each, as long as the areas (map_similarity.h). The interval of the reliability
/// leaves out each observer in turn (jackknife), with Fisher's z and Student's quantile; that needs three
/// observers. Drawing observers again would have the same one agree with itself. Both are absent for fewer
/// than two maps, and where their sum is constant.
MapAgreement map_agreement(std::span<const std::vector<double>> of_observers, std::span<const double> areas,
                           double confidence);

} // namespace overt
