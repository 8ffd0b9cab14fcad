/// Intervals of confidence by drawing observers again, with replacement.
///
/// Observers are drawn and not fixations, since one observer's fixations depend on each other and the study
/// is meant to speak of other observers. Everything follows from the seed, whatever the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

struct BootstrapSettings {
    int resamples = 2000;
    double confidence = 0.95;
    std::uint64_t seed = 1;
};

/// A number of some of 0 … count-1, each as often as it was drawn; nothing if these have none. Is called from
/// several threads.
using StatisticOf = std::function<std::optional<double>(std::span<const std::uint32_t>)>;

/// Efron's interval, corrected for bias and acceleration (BCa; Efron 1987, JASA 82, 171-185), with the
/// acceleration by the jackknife, and expanded for the number of items (expanded_confidence). Draws for which
/// the statistic has no value are left out. Nothing for fewer than three items, if the statistic of all has
/// no value, or if fewer than half of the draws have one. Where all draws give the same, that is both ends.
std::optional<Interval> bootstrap_interval(std::uint32_t count, const StatisticOf& statistic,
                                           const BootstrapSettings& settings);

/// The level at which the quantiles of draws are taken so that an interval of so few holds the truth about as
/// often as `confidence` says: draws vary as if the variance were divided by count, not count - 1, and as if
/// it were known (Hesterberg, The American Statistician 69(4), 2015, 371-386). `count` >= 2.
double expanded_confidence(double confidence, std::uint32_t count);

/// The same of the mean of numbers; of fewer than six, Student's interval, since draws of these do not reach
/// far enough.
std::optional<Interval> bootstrap_interval_of_mean(std::span<const double> values,
                                                   const BootstrapSettings& settings);

/// The mean with that interval. Without values, absent for the `reason`.
Estimate estimated_mean(std::span<const double> values, const BootstrapSettings& settings,
                        const std::string& reason);

/// Student's interval about a number of n observers from the values that it has without each of them (the
/// jackknife; Tukey 1958), for what is more than a mean: where observers depend on each other since all are
/// compared with all. Nothing with fewer than four.
std::optional<Interval> jackknife_interval(double value, std::span<const double> without, double confidence);

/// The ends of the interval from the draws' values, the value of all, and the values of the jackknife.
Interval bca_interval(std::vector<double> draws, double observed, std::span<const double> jackknife,
                      double confidence);

/// The value below which a share of the sorted values lies, between them linearly (type 7 of Hyndman and Fan
/// 1996, numpy's default). At least one value; 0 <= share <= 1.
double quantile_of_sorted(std::span<const double> sorted, double share);

} // namespace overt
