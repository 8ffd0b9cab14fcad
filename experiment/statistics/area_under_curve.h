/// How well a map tells places that were fixated from others: areas under curves of the receiver's operating
/// characteristic, in the two forms of the MIT saliency benchmark.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace overt {

/// AUC after Judd: the thresholds are the map's values at the fixations; at the i-th highest the hits are
/// i / N of the fixations, and the false alarms (A / m - i) / (M - N) with the area A on which the map
/// reaches the threshold, the number M of places with area and their mean area m. On equal areas that is the
/// benchmark's formula, without its random jitter. Values that differ by rounding are the same (1e-12 of the
/// highest), so that a constant map has 0.5. Nothing without fixations, or with as many as places.
std::optional<double> auc_judd(std::span<const double> map, std::span<const double> areas,
                               std::span<const double> at_fixations);

/// One split of AUC after Borji: the map's values at the fixations against those at equally many random
/// places, at thresholds in steps of `step` from 0 to the highest value. The map is meant to be scaled to 0 …
/// 1.
double auc_by_steps(std::span<const double> at_fixations, std::span<const double> at_random, double step);

/// AUC after Borji: the mean over random splits (100 in the benchmark, steps of 0.1) of auc_by_steps, of the
/// map scaled to 0 … 1. Places are drawn with replacement, with probabilities as their areas. Nothing without
/// fixations, or of a constant map.
std::optional<double> auc_borji(std::span<const double> map, std::span<const double> areas,
                                std::span<const double> at_fixations, std::uint64_t seed, int splits = 100,
                                double step = 0.1);

} // namespace overt
