#include "experiment/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Draws at a time: a thread's turn must be worth its taking.
constexpr int draws_at_a_time = 64;

/// Means of fewer cannot be drawn as far apart as they may be from the truth.
constexpr std::size_t least_for_draws = 6;

/// Student's interval.
Interval interval_of_few(std::span<const double> values, double confidence) {
    const double mean = mean_of(values), degrees = static_cast<double>(values.size()) - 1.0;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    const double half = student_quantile(0.5 + 0.5 * confidence, degrees) *
                        std::sqrt(squares / degrees / static_cast<double>(values.size()));
    return {mean - half, mean + half};
}

} // namespace

double expanded_confidence(double confidence, std::uint32_t count) {
    const double few = count, quantile = student_quantile(0.5 + 0.5 * confidence, few - 1.0);
    return 2.0 * normal_probability(std::sqrt(few / (few - 1.0)) * quantile) - 1.0;
}

double quantile_of_sorted(std::span<const double> sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= sorted.size())
        return sorted.back();
    const double part = place - static_cast<double>(below);
    return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

Interval bca_interval(std::vector<double> draws, double observed, std::span<const double> jackknife,
                      double confidence) {
    std::sort(draws.begin(), draws.end());
    if (draws.front() == draws.back())
        return {draws.front(), draws.front()};
    // Values equal to the observed one count half, as scipy.stats.bootstrap has it.
    const auto count = static_cast<double>(draws.size());
    const auto less = std::lower_bound(draws.begin(), draws.end(), observed) - draws.begin();
    const auto up_to = std::upper_bound(draws.begin(), draws.end(), observed) - draws.begin();
    double below = static_cast<double>(less + up_to) / (2.0 * count);
    below = std::clamp(below, 0.5 / count, 1.0 - 0.5 / count); // an infinite bias tells nothing
    const double bias = normal_quantile(below);
    const double mean = mean_of(jackknife);
    double squares = 0.0, cubes = 0.0;
    for (const double value : jackknife) {
        squares += (mean - value) * (mean - value);
        cubes += (mean - value) * (mean - value) * (mean - value);
    }
    const double acceleration = squares > 0.0 ? cubes / (6.0 * std::pow(squares, 1.5)) : 0.0;
    const auto end = [&](double share) {
        const double z = bias + normal_quantile(share);
        return quantile_of_sorted(draws, normal_probability(bias + z / (1.0 - acceleration * z)));
    };
    const double outside = 0.5 * (1.0 - confidence);
    return {end(outside), end(1.0 - outside)};
}

std::optional<Interval> jackknife_interval(double value, std::span<const double> without, double confidence) {
    constexpr std::size_t least_for_jackknife = 4;
    if (without.size() < least_for_jackknife)
        return std::nullopt;
    const auto n = static_cast<double>(without.size());
    const double mean = mean_of(without);
    double squares = 0.0;
    for (const double one : without)
        squares += (one - mean) * (one - mean);
    const double half =
        student_quantile(0.5 + 0.5 * confidence, n - 1.0) * std::sqrt((n - 1.0) / n * squares);
    return Interval{value - half, value + half};
}

std::optional<Interval> bootstrap_interval(std::uint32_t count, const StatisticOf& statistic,
                                           const BootstrapSettings& settings) {
    if (count < 3)
        return std::nullopt;
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    const std::optional<double> observed = statistic(all);
    if (!observed)
        return std::nullopt;
    std::vector<std::optional<double>> values(static_cast<std::size_t>(settings.resamples));
    const int turns = (settings.resamples + draws_at_a_time - 1) / draws_at_a_time;
    parallel_for(turns, [&](int turn) {
        std::vector<std::uint32_t> drawn(count);
        const int end = std::min(settings.resamples, (turn + 1) * draws_at_a_time);
        for (int i = turn * draws_at_a_time; i < end; ++i) {
            RandomStream random(settings.seed, "bootstrap", static_cast<std::uint64_t>(i));
            for (std::uint32_t& one : drawn)
                one = random.below(count);
            values[static_cast<std::size_t>(i)] = statistic(drawn);
        }
    });
    std::vector<double> draws, jackknife;
    for (const std::optional<double>& value : values) {
        if (value)
            draws.push_back(*value);
    }
    if (draws.size() * 2 < values.size())
        return std::nullopt;
    std::vector<std::uint32_t> others(all.begin() + 1, all.end());
    for (std::uint32_t left_out = 0; left_out < count; ++left_out) {
        if (left_out > 0)
            others[left_out - 1] = left_out - 1;
        if (const std::optional<double> value = statistic(others))
            jackknife.push_back(*value);
    }
    if (jackknife.empty())
        return std::nullopt;
    return bca_interval(std::move(draws), *observed, jackknife,
                        expanded_confidence(settings.confidence, count));
}

std::optional<Interval> bootstrap_interval_of_mean(std::span<const double> values,
                                                   const BootstrapSettings& settings) {
    if (values.size() >= 3 && values.size() < least_for_draws)
        return interval_of_few(values, settings.confidence);
    return bootstrap_interval(
        static_cast<std::uint32_t>(values.size()),
        [&](std::span<const std::uint32_t> drawn) -> std::optional<double> {
            double sum = 0.0;
            for (const std::uint32_t i : drawn)
                sum += values[i];
            return sum / static_cast<double>(drawn.size());
        },
        settings);
}

Estimate estimated_mean(std::span<const double> values, const BootstrapSettings& settings,
                        const std::string& reason) {
    if (values.empty())
        return Estimate::none(reason);
    return Estimate::of(mean_of(values), bootstrap_interval_of_mean(values, settings));
}

} // namespace overt
