/// Tests that compare what was found with what exchanging labels would give.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overt {

struct PermutationSettings {
    int permutations = 5000;           ///< random ones, where there are too many for all
    std::uint64_t most_exact = 100000; ///< up to so many all are made
    std::uint64_t seed = 1;
};

/// p, and how it came about.
struct TestResult {
    double p = 1.0; ///< two-sided, > 0
    bool is_exact = false;
    std::uint64_t permutations = 0;
};

/// Whether differences within observers have another mean than 0: each may as well have the other sign. Two-
/// sided by the size of the sum. Exact where the 2^n flips are few enough; else random flips, where p counts
/// the observed one too, (1 + hits) / (1 + flips), so that it is never 0 and its error of the first kind
/// holds (Phipson and Smyth 2010). Nothing without differences.
std::optional<TestResult> sign_flip_test(std::span<const double> differences,
                                         const PermutationSettings& settings = {});

/// Whether two groups of observers have different means: each may as well belong to the other. Two-sided,
/// exact over all choices where these are few enough. Nothing if a group is empty.
std::optional<TestResult> label_permutation_test(std::span<const double> a, std::span<const double> b,
                                                 const PermutationSettings& settings = {});

/// p of an observed number among those that permutations gave, one-sided: how often chance gives as little.
double p_of_least(double observed, std::span<const double> permuted);

/// The p values after Holm (1979): each at least as large as before, in the order in which they were given.
std::vector<double> holm(std::span<const double> p);

/// The same after Benjamini and Hochberg (1995), for the false discovery rate.
std::vector<double> benjamini_hochberg(std::span<const double> p);

} // namespace overt
