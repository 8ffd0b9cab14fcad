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
constexpr std::size_t least_for_draws = 10;
/// The same where numbers have a least or a largest, since then Student's interval has a better scale.
constexpr std::size_t least_for_draws_in_a_range = 25;

constexpr std::size_t least_observers = 3;

double mean_at(std::span<const double> values, std::span<const std::uint32_t> drawn) {
    double sum = 0.0;
    for (const std::uint32_t i : drawn)
        sum += values[i];
    return sum / static_cast<double>(drawn.size());
}

/// Of an estimate with its standard error, on the scale that the range asks for.
Interval student_interval(double value, double standard_error, double degrees, double confidence,
                          Interval range) {
    const double half = student_quantile(0.5 + 0.5 * confidence, degrees) * standard_error;
    if (!std::isfinite(range.low))
        return {value - half, value + half};
    const double above = value - range.low, below = range.high - value;
    // Numbers of which a weighted mean lies beyond the range, such as shares without the tracker's error.
    if (!(above > 0.0) || !(below > 0.0))
        return {std::clamp(value - half, range.low, range.high),
                std::clamp(value + half, range.low, range.high)};
    if (!std::isfinite(range.high)) {
        const double factor = std::exp(half / above);
        return {range.low + above / factor, range.low + above * factor};
    }
    const double odds = above / below, factor = std::exp(half / above + half / below);
    const auto at = [&](double of_odds) {
        return range.low + (range.high - range.low) * of_odds / (1.0 + of_odds);
    };
    return {at(odds / factor), at(odds * factor)};
}

Interval student_interval_of_mean(std::span<const double> values, double confidence, Interval range) {
    const double mean = mean_of(values), degrees = static_cast<double>(values.size()) - 1.0;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return student_interval(mean, std::sqrt(squares / degrees / static_cast<double>(values.size())), degrees,
                            confidence, range);
}

/// The statistic without each item in turn, of those that have one.
std::vector<double> without_each(std::uint32_t count, const StatisticOf& statistic) {
    std::vector<double> values;
    std::vector<std::uint32_t> others(count - 1);
    std::iota(others.begin(), others.end(), 1u);
    for (std::uint32_t left_out = 0; left_out < count; ++left_out) {
        if (left_out > 0)
            others[left_out - 1] = left_out - 1;
        if (const std::optional<double> value = statistic(others))
            values.push_back(*value);
    }
    return values;
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
    std::vector<double> draws;
    for (const std::optional<double>& value : values) {
        if (value)
            draws.push_back(*value);
    }
    if (draws.size() * 2 < values.size())
        return std::nullopt;
    const std::vector<double> jackknife = without_each(count, statistic);
    if (jackknife.empty())
        return std::nullopt;
    return bca_interval(std::move(draws), *observed, jackknife,
                        expanded_confidence(settings.confidence, count));
}

std::optional<Interval> interval_in_range(std::uint32_t count, const StatisticOf& statistic,
                                          const BootstrapSettings& settings, Interval range) {
    if (count < least_observers)
        return std::nullopt;
    if (count >= least_for_draws_in_a_range) {
        const auto interval = bootstrap_interval(count, statistic, settings);
        return interval ? Estimate::of(0.0, interval).cut_to(range).interval : std::nullopt;
    }
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    const std::optional<double> observed = statistic(all);
    const std::vector<double> without = without_each(count, statistic);
    if (!observed || without.size() < count)
        return std::nullopt;
    const double mean = mean_of(without), degrees = static_cast<double>(count) - 1.0;
    double squares = 0.0;
    for (const double value : without)
        squares += (value - mean) * (value - mean);
    return student_interval(*observed, std::sqrt(degrees / (degrees + 1.0) * squares), degrees,
                            settings.confidence, range);
}

std::optional<Interval> interval_of_mean(std::span<const double> values, const BootstrapSettings& settings,
                                         Interval range) {
    const std::size_t least = std::isfinite(range.low) ? least_for_draws_in_a_range : least_for_draws;
    if (values.size() >= least_observers && values.size() < least)
        return student_interval_of_mean(values, settings.confidence, range);
    const std::optional<Interval> interval = bootstrap_interval(
        static_cast<std::uint32_t>(values.size()),
        [&](std::span<const std::uint32_t> drawn) { return std::optional(mean_at(values, drawn)); },
        settings);
    return Estimate::of(0.0, interval).cut_to(range).interval;
}

Estimate estimated_mean(std::span<const double> values, const BootstrapSettings& settings,
                        const std::string& reason, Interval range) {
    if (values.empty())
        return Estimate::none(reason);
    return Estimate::of(mean_of(values), interval_of_mean(values, settings, range));
}

} // namespace overt
