#include "experiment/statistics/permutation.h"

#include <algorithm>
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

TestResult of_random(std::uint64_t hits, int permutations) {
    return {static_cast<double>(hits + 1) / (permutations + 1.0), false,
            static_cast<std::uint64_t>(permutations)};
}

/// How many ways there are to choose k of n; limit + 1 if more than the limit.
std::uint64_t choices(std::uint64_t n, std::uint64_t k, std::uint64_t limit) {
    std::uint64_t ways = 1;
    for (std::uint64_t i = 1; i <= std::min(k, n - k); ++i) {
        ways = ways * (n + 1 - i) / i;
        if (ways > limit)
            return limit + 1;
    }
    return ways;
}

std::vector<std::size_t> rising_order(std::span<const double> p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    return order;
}

} // namespace

std::optional<TestResult> sign_flip_test(std::span<const double> differences,
                                         const PermutationSettings& settings) {
    if (differences.empty())
        return std::nullopt;
    const double observed = std::accumulate(differences.begin(), differences.end(), 0.0);
    const double threshold = threshold_for(observed, differences);
    const std::size_t n = differences.size();
    if (n < 63 && (std::uint64_t{1} << n) <= settings.most_exact) {
        const std::uint64_t all = std::uint64_t{1} << n;
        std::uint64_t hits = 0;
        for (std::uint64_t flips = 0; flips < all; ++flips) {
            double sum = 0.0;
            for (std::size_t i = 0; i < n; ++i)
                sum += (flips >> i & 1u) ? -differences[i] : differences[i];
            hits += std::abs(sum) >= threshold;
        }
        return TestResult{static_cast<double>(hits) / static_cast<double>(all), true, all};
    }
    std::uint64_t hits = 0;
    for (int permutation = 0; permutation < settings.permutations; ++permutation) {
        RandomStream random(settings.seed, "sign flips", static_cast<std::uint64_t>(permutation));
        double sum = 0.0;
        for (const double difference : differences)
            sum += (random.next_bits() & 1u) ? -difference : difference;
        hits += std::abs(sum) >= threshold;
    }
    return of_random(hits, settings.permutations);
}

std::optional<TestResult> label_permutation_test(std::span<const double> a, std::span<const double> b,
                                                 const PermutationSettings& settings) {
    if (a.empty() || b.empty())
        return std::nullopt;
    std::vector<double> all(a.begin(), a.end());
    all.insert(all.end(), b.begin(), b.end());
    const double total = std::accumulate(all.begin(), all.end(), 0.0);
    const auto in_a = static_cast<double>(a.size()), in_b = static_cast<double>(b.size());
    const auto difference = [&](double sum_of_a) { return sum_of_a / in_a - (total - sum_of_a) / in_b; };
    const double observed = difference(std::accumulate(a.begin(), a.end(), 0.0));
    const double threshold = threshold_for(observed, all);
    const std::uint64_t ways = choices(all.size(), a.size(), settings.most_exact);
    std::uint64_t hits = 0;
    if (ways <= settings.most_exact) {
        // All choices of as many indices, in lexicographic order.
        std::vector<std::size_t> chosen(a.size());
        std::iota(chosen.begin(), chosen.end(), 0u);
        for (std::uint64_t way = 0; way < ways; ++way) {
            double sum = 0.0;
            for (const std::size_t i : chosen)
                sum += all[i];
            hits += std::abs(difference(sum)) >= threshold;
            std::size_t last = chosen.size();
            while (last > 0 && chosen[last - 1] == all.size() - chosen.size() + last - 1)
                --last;
            if (last == 0)
                break;
            ++chosen[last - 1];
            for (std::size_t i = last; i < chosen.size(); ++i)
                chosen[i] = chosen[i - 1] + 1;
        }
        return TestResult{static_cast<double>(hits) / static_cast<double>(ways), true, ways};
    }
    for (int permutation = 0; permutation < settings.permutations; ++permutation) {
        RandomStream random(settings.seed, "labels", static_cast<std::uint64_t>(permutation));
        std::vector<double> shuffled = all;
        random.shuffle(std::span(shuffled));
        hits += std::abs(difference(std::accumulate(
                    shuffled.begin(), shuffled.begin() + static_cast<std::ptrdiff_t>(a.size()), 0.0))) >=
                threshold;
    }
    return of_random(hits, settings.permutations);
}

double p_of_least(double observed, std::span<const double> permuted) {
    const auto hits = std::count_if(permuted.begin(), permuted.end(),
                                    [&](double value) { return value <= observed + 1e-12; });
    return static_cast<double>(hits + 1) / static_cast<double>(permuted.size() + 1);
}

std::vector<double> holm(std::span<const double> p) {
    std::vector<double> corrected(p.size());
    double most = 0.0;
    auto remaining = static_cast<double>(p.size());
    for (const std::size_t i : rising_order(p)) {
        most = std::max(most, std::min(1.0, p[i] * remaining--));
        corrected[i] = most;
    }
    return corrected;
}

std::vector<double> benjamini_hochberg(std::span<const double> p) {
    std::vector<double> corrected(p.size());
    const std::vector<std::size_t> order = rising_order(p);
    double least = 1.0;
    for (std::size_t rank = order.size(); rank > 0; --rank) {
        const std::size_t i = order[rank - 1];
        least = std::min(least, p[i] * static_cast<double>(p.size()) / static_cast<double>(rank));
        corrected[i] = least;
    }
    return corrected;
}

} // namespace overt
