/// Tests that compare what was found with what exchanging labels would give.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// How often a flip of signs, each 1 or -1, is a hit. Flips of all of them must be hits or not together.
/// `count` > 0. Exact where the 2^count flips are few enough; else random flips by `purpose`, where p counts
/// the observed one too, (1 + hits) / (1 + flips), so that it is never 0 and its error of the first kind
/// holds (Phipson and Smyth 2010).
TestResult flip_test(std::size_t count, const char* purpose, const PermutationSettings& settings,
                     const std::function<bool(std::span<const double> signs)>& is_hit);

/// Whether differences within observers have another mean than 0: each may as well have the other sign
/// (flip_test). Two-sided by the size of the sum. Nothing of fewer than two: of one both ways are as likely.
std::optional<TestResult> sign_flip_test(std::span<const double> differences,
                                         const PermutationSettings& settings = {});

/// p of an observed number among those that permutations gave, one-sided: how often chance gives as little.
double p_of_least(double observed, std::span<const double> permuted);

/// The p values after Holm (1979): each at least as large as before, in the order in which they were given.
std::vector<double> holm(std::span<const double> p);

} // namespace overt
