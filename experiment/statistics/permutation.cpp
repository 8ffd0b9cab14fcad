#include "experiment/statistics/permutation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "experiment/base/random.h"

namespace overt {

namespace {

/// Equal sums in another order differ by rounding: they count as equal.
double threshold_for(double observed, std::span<const double> values) {
    double size = 0.0;
    for (const double value : values)
        size += std::abs(value);
    return std::abs(observed) - 1e-12 * size;
}

} // namespace

TestResult flip_test(std::size_t count, const char* purpose, const PermutationSettings& settings,
                     const std::function<bool(std::span<const double> signs)>& is_hit) {
    std::vector<double> signs(count, 1.0);
    std::uint64_t hits = 0;
    if (count < 63 && (std::uint64_t{1} << count) <= settings.most_exact) {
        // Half of the ways tell all. Neighbours in this order differ by one sign (Gray's code).
        const std::uint64_t half = std::uint64_t{1} << (count - 1);
        for (std::uint64_t way = 0; way < half; ++way) {
            if (way > 0)
                signs[static_cast<std::size_t>(std::countr_zero(way))] *= -1.0;
            hits += is_hit(signs);
        }
        return {static_cast<double>(hits) / static_cast<double>(half), true, 2 * half};
    }
    for (int permutation = 0; permutation < settings.permutations; ++permutation) {
        RandomStream random(settings.seed, purpose, static_cast<std::uint64_t>(permutation));
        for (double& sign : signs)
            sign = (random.next_bits() & 1u) ? -1.0 : 1.0;
        hits += is_hit(signs);
    }
    return {static_cast<double>(hits + 1) / (settings.permutations + 1.0), false,
            static_cast<std::uint64_t>(settings.permutations)};
}

std::optional<TestResult> sign_flip_test(std::span<const double> differences,
                                         const PermutationSettings& settings) {
    if (differences.size() < 2)
        return std::nullopt;
    const double observed = std::accumulate(differences.begin(), differences.end(), 0.0);
    const double threshold = threshold_for(observed, differences);
    return flip_test(differences.size(), "sign flips", settings, [&](std::span<const double> signs) {
        const double sum = std::inner_product(signs.begin(), signs.end(), differences.begin(), 0.0);
        return std::abs(sum) >= threshold;
    });
}

double p_of_least(double observed, std::span<const double> permuted) {
    const auto hits = std::count_if(permuted.begin(), permuted.end(),
                                    [&](double value) { return value <= observed + 1e-12; });
    return static_cast<double>(hits + 1) / static_cast<double>(permuted.size() + 1);
}

std::vector<double> holm(std::span<const double> p) {
    std::vector<std::size_t> rising(p.size());
    std::iota(rising.begin(), rising.end(), 0u);
    std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return p[i]; });
    std::vector<double> corrected(p.size());
    double most = 0.0;
    auto remaining = static_cast<double>(p.size());
    for (const std::size_t i : rising) {
        most = std::max(most, std::min(1.0, p[i] * remaining--));
        corrected[i] = most;
    }
    return corrected;
}

} // namespace overt
