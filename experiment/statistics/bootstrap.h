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

/// The interval of a statistic that lies in a range with a least number, or a least and a largest: Student's
/// of its logarithm, or of the logit of its place between these, with the standard error of the jackknife, so
/// that it ends within the range; of 25 items and more the bootstrap. Nothing for fewer than three, or if the
/// statistic has no value of all or without any. Where its value is at an end of the range, the interval is
/// that end.
///
/// Of 3,000 studies each of 6 … 24 observers with shares, counts and durations that differed by 20 to 100 %
/// between observers it held the mean in 93 to 96 % (in 90 to 91 % of log-normal numbers that differed by
/// 100 %), the bootstrap in 88 to 96 % (86 to 91 %).
std::optional<Interval> interval_in_range(std::uint32_t count, const StatisticOf& statistic,
                                          const BootstrapSettings& settings, Interval range);

/// That of the mean of numbers. Of numbers that can be anywhere the bootstrap; of fewer than ten Student's,
/// since draws of so few do not reach far enough. Nothing for fewer than three.
std::optional<Interval> interval_of_mean(std::span<const double> values, const BootstrapSettings& settings,
                                         Interval range = any_number);

/// The mean with that interval. Without values, absent for the `reason`.
Estimate estimated_mean(std::span<const double> values, const BootstrapSettings& settings,
                        const std::string& reason, Interval range = any_number);

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
