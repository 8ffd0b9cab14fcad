/// Whether a factor has an effect, when each observer was measured at several of its levels.
///
/// Both tests flip the signs of whole observers, and take nothing else for exchangeable: levels may differ in
/// how much observers differ at them (no sphericity is assumed), and an observer who lacks a level or a cell
/// stays with what there is.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiment/statistics/permutation.h"

namespace overt {

/// Numbers of trials. All lists are by trial.
struct FactorTrials {
    std::vector<double> values;
    std::vector<std::size_t> observers; ///< from 0
    std::vector<std::size_t>
        cells; ///< what is tested: the level; of two factors a and b, a * levels of b + b
    /// What is no effect: by trial the number of a group, from 0. The sum of a number for each group of each
    /// list is taken off; so is each observer's mean.
    std::vector<std::vector<std::size_t>> beside;
};

struct FactorTest {
    /// Of all contrasts the largest |sum| / root of the sum of squares of what observers give to it: the root
    /// of their number where all give the same, about 1 by chance.
    double statistic = 0.0;
    TestResult test;
    double least_p = 1.0; ///< no p of so many observers can be smaller
    int observers = 0;    ///< who take part: who give to any contrast
};

/// Main effect: contrasts are the differences of each two levels. Observers with one level alone are left
/// out. Nothing if fewer than two observers give to any contrast.
///
/// Of values and contrasts what observers' means and `beside` tell is taken off (least squares). What
/// an observer gives to a contrast is then the sum over trials of the product of both. Where the factor has
/// no effect each observer's gifts may as well have the opposite signs, all at once (Hemerik, Goeman and
/// Finos, J. R. Stat. Soc. B 82, 2020, 841-864). What was taken off makes flipped sums too small; each is
/// divided by the share of its standard deviation that is left then (De Santis, Goeman, Hemerik, Davenport
/// and Finos, 2022, arXiv 2209.13918, equation 7, with signs of observers for those of single values). p is
/// of the largest contrast (max-T): exact over all 2^n flips where these are at most settings.most_exact.
std::optional<FactorTest> main_effect_test(FactorTrials trials, std::size_t levels,
                                           const PermutationSettings& settings = {});

/// Interaction of two factors, in the same way: contrasts are differences of differences, of each two levels
/// of either; where these are more than 60, each cell by itself. `beside` has to tell all that either factor
/// does alone.
std::optional<FactorTest> interaction_test(const FactorTrials& trials, std::size_t levels_of_a,
                                           std::size_t levels_of_b, const PermutationSettings& settings = {});

} // namespace overt
