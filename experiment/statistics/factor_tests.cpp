#include "experiment/statistics/factor_tests.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/log_gamma.h"
#include "experiment/base/random.h"

namespace overt {

namespace {

/// Equal sums in another order differ by rounding: they count as equal.
constexpr double all_but_rounding = 1.0 - 1e-9;

/// Those with two levels at least, less their own mean.
std::vector<LevelMeans> less_own_mean(std::span<const LevelMeans> all) {
    std::vector<LevelMeans> found;
    for (LevelMeans own : all) {
        double sum = 0.0;
        int count = 0;
        for (const std::optional<double>& mean : own) {
            sum += mean.value_or(0.0);
            count += mean.has_value();
        }
        if (count < 2)
            continue;
        for (std::optional<double>& mean : own) {
            if (mean)
                *mean -= sum / count;
        }
        found.push_back(std::move(own));
    }
    return found;
}

double spread_of_levels(const std::vector<LevelMeans>& observers) {
    double statistic = 0.0;
    for (std::size_t level = 0; level < observers.front().size(); ++level) {
        double sum = 0.0;
        int count = 0;
        for (const LevelMeans& own : observers) {
            sum += own[level].value_or(0.0);
            count += own[level].has_value();
        }
        statistic += count > 0 ? sum * sum / count : 0.0;
    }
    return statistic;
}

void exchange_levels(LevelMeans& own, RandomStream& random) {
    std::vector<double> values;
    for (const std::optional<double>& mean : own) {
        if (mean)
            values.push_back(*mean);
    }
    random.shuffle(std::span(values));
    std::size_t next = 0;
    for (std::optional<double>& mean : own) {
        if (mean)
            *mean = values[next++];
    }
}

/// One in so many exchanges is what was found: where all have all levels, the same exchange in every observer
/// gives the same statistic.
double least_p_of_exchanges(const std::vector<LevelMeans>& observers) {
    double log_ways = 0.0;
    bool all_have_all = true;
    for (const LevelMeans& own : observers) {
        const auto count = std::ranges::count_if(own, [](const auto& mean) { return mean.has_value(); });
        log_ways += log_gamma(static_cast<double>(count) + 1.0);
        all_have_all &= static_cast<std::size_t>(count) == own.size();
    }
    if (all_have_all)
        log_ways -= log_gamma(static_cast<double>(observers.front().size()) + 1.0);
    return std::exp(-log_ways);
}

/// Those of whom all cells are there, centred along both factors.
std::vector<std::vector<double>> centred_both_ways(std::span<const LevelMeans> all, std::size_t b) {
    std::vector<std::vector<double>> found;
    for (const LevelMeans& own : all) {
        if (!std::ranges::all_of(own, [](const auto& mean) { return mean.has_value(); }))
            continue;
        const std::size_t a = own.size() / b;
        std::vector<double> of_a(a, 0.0), of_b(b, 0.0);
        double mean = 0.0;
        for (std::size_t i = 0; i < a * b; ++i) {
            of_a[i / b] += *own[i] / static_cast<double>(b);
            of_b[i % b] += *own[i] / static_cast<double>(a);
            mean += *own[i] / static_cast<double>(a * b);
        }
        std::vector<double>& rest = found.emplace_back();
        for (std::size_t i = 0; i < a * b; ++i)
            rest.push_back(*own[i] - of_a[i / b] - of_b[i % b] + mean);
    }
    return found;
}

double size_of_mean(const std::vector<std::vector<double>>& observers, std::span<const double> signs) {
    double size = 0.0;
    for (std::size_t i = 0; i < observers.front().size(); ++i) {
        double sum = 0.0;
        for (std::size_t o = 0; o < observers.size(); ++o)
            sum += signs[o] * observers[o][i];
        size += sum * sum;
    }
    const auto count = static_cast<double>(observers.size());
    return size / (count * count);
}

} // namespace

std::optional<FactorTest> level_exchange_test(std::span<const LevelMeans> all,
                                              const PermutationSettings& settings) {
    const std::vector<LevelMeans> observers = less_own_mean(all);
    if (observers.size() < 2)
        return std::nullopt;
    FactorTest found;
    found.observers = static_cast<int>(observers.size());
    found.statistic = spread_of_levels(observers);
    const double threshold = found.statistic * all_but_rounding;
    int hits = 0;
    std::vector<LevelMeans> exchanged;
    for (int i = 0; i < settings.permutations; ++i) {
        RandomStream random(settings.seed, "levels of observers", static_cast<std::uint64_t>(i));
        exchanged = observers;
        for (LevelMeans& own : exchanged)
            exchange_levels(own, random);
        hits += spread_of_levels(exchanged) >= threshold;
    }
    found.test = {(hits + 1.0) / (settings.permutations + 1.0), false,
                  static_cast<std::uint64_t>(settings.permutations)};
    found.least_p = std::max(least_p_of_exchanges(observers), 1.0 / (settings.permutations + 1.0));
    return found;
}

std::optional<FactorTest> interaction_flip_test(std::span<const LevelMeans> all, std::size_t levels_of_b,
                                                const PermutationSettings& settings) {
    const std::vector<std::vector<double>> observers = centred_both_ways(all, levels_of_b);
    if (observers.size() < 2)
        return std::nullopt;
    FactorTest found;
    const std::size_t n = observers.size();
    found.observers = static_cast<int>(n);
    found.statistic = size_of_mean(observers, std::vector(n, 1.0));
    const double threshold = found.statistic * all_but_rounding;
    found.test = flip_test(n, "signs of observers", settings, [&](std::span<const double> signs) {
        return size_of_mean(observers, signs) >= threshold;
    });
    found.least_p = found.test.is_exact ? 2.0 / static_cast<double>(found.test.permutations)
                                        : 1.0 / (settings.permutations + 1.0);
    return found;
}

} // namespace overt
