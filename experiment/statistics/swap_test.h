/// Whether the maps of two conditions differ, when the same observers made both.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/statistics/permutation.h"

namespace overt {

/// Maps of observers in two conditions on one surface, and of these what correlations of their sums need: the
/// inner products of each observer's sum and difference with all others'.
class PairedMaps {
  public:
    /// By place of the surface; see map_similarity.h.
    explicit PairedMaps(std::span<const double> areas);

    /// Both maps of an observer, each as long as the areas. Every observer once, in rising order.
    void add(std::size_t observer, std::span<const double> a, std::span<const double> b);

    struct OfObserver {
        std::size_t observer = 0;
        std::vector<double> sum, difference; ///< of both maps, each less its mean over the surface
        // Inner products with the observers up to this one.
        std::vector<double> sums, differences;
        std::vector<double> sum_by_differences, difference_by_sums;
    };
    const std::vector<OfObserver>& observers() const { return observers_; }

  private:
    double product(std::span<const double> a, std::span<const double> b) const;

    std::vector<double> areas_;
    std::vector<OfObserver> observers_;
};

/// The correlation of both conditions' maps, each summed over observers, and how often swaps give as little.
struct SwapTest {
    double correlation = 0.0; ///< mean over the surfaces
    TestResult test;          ///< one-sided: as small a correlation
};

/// Swaps the two conditions of an observer, on all surfaces at once: where the condition makes no difference,
/// each way of swapping was as probable. p tells how many of the ways give a mean correlation as small as the
/// observed one, of all ways where their number, 2^n, is at most settings.most_exact, else of random ones and
/// counting the observed one (Phipson and Smyth 2010). The fixations of a map may depend on each other, as
/// they do under one error of calibration: only whole maps are swapped.
///
/// Takes part who is below `observers`. Nothing if these are fewer than two, of whom both ways of swapping
/// are as likely, or if a sum is constant on all surfaces.
std::optional<SwapTest> swap_test(std::span<const PairedMaps> surfaces, std::size_t observers,
                                  const PermutationSettings& settings = {});

} // namespace overt
