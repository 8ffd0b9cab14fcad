/// How well maps would come out again with other observers: split-half reliability.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"

namespace overt {

/// Rows for each group, for each level of each column of `--by`, and for all trials, on each object.
/// Observers are split into halves at random (`options.splits` times); the value is the mean correlation of
/// the halves' maps (fixations count alike) over the places that could be seen, and what Spearman and Brown's
/// formula makes of it for all observers. The interval of the reliability comes from leaving out each
/// observer in turn (jackknife), with Fisher's z and Student's quantile; that needs three observers. Drawing
/// observers again would put the same one into both halves, which makes them alike.
std::vector<MapReliabilityRow> map_reliabilities(const StudyResults& results, const ObjectFixationMaps& maps,
                                                 const LevelLists& levels, const StudyOptions& options);

/// The same of maps that are given, one for each observer; public for its test. Both estimates are absent for
/// fewer than two maps.
struct SplitHalf {
    Estimate correlation, reliability;
};
SplitHalf split_half_of(std::span<const std::vector<double>> of_observers, std::span<const double> areas,
                        int splits, double confidence, std::uint64_t seed);

} // namespace overt
