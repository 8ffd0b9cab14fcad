/// Whether a factor has an effect, when each observer was measured at several of its levels.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/statistics/permutation.h"

namespace overt {

/// An observer's mean at each level, or nothing.
using LevelMeans = std::vector<std::optional<double>>;

struct FactorTest {
    double statistic = 0.0;
    TestResult test;
    double least_p = 1.0; ///< no p of so many observers and levels can be smaller
    int observers = 0;    ///< who take part
};

/// Main effect. From each observer's means their own mean is taken off; the statistic is the sum over levels
/// of the number of observers at the level times the square of their mean. Where the factor has no effect an
/// observer's means may as well belong to each other's levels: they are exchanged within every observer, at
/// random, and p counts what was found as one of the exchanges (Phipson and Smyth 2010). Observers with fewer
/// than two levels are left out. Nothing if fewer than two are left.
std::optional<FactorTest> level_exchange_test(std::span<const LevelMeans> all,
                                              const PermutationSettings& settings = {});

/// Interaction of two factors: means by level of a, and within it of b. Each observer's are centred along
/// both factors; the statistic is the sum over cells of the square of the mean over observers. Where there is
/// no interaction an observer's cells may as well have the opposite signs, all at once: exact over all 2^n
/// where these are at most settings.most_exact, else random flips. Observers without all cells are left out.
/// Nothing if fewer than two are left.
std::optional<FactorTest> interaction_flip_test(std::span<const LevelMeans> all, std::size_t levels_of_b,
                                                const PermutationSettings& settings = {});

} // namespace overt
