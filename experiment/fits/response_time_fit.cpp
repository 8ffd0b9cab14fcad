#include "experiment/fits/response_time_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

constexpr std::size_t least_times = 10;
constexpr double least_spread = 1e-9; ///< of the mean: less is rounding
const double log_root_two_pi = 0.5 * std::log(2.0 * std::numbers::pi);

/// Logarithm of the normal probability, also far down where the probability itself is 0: there by the first
/// terms of its asymptotic series.
double log_normal_probability(double z) {
    if (z > -30.0)
        return std::log(normal_probability(z));
    const double square = 1.0 / (z * z);
    return -0.5 * z * z - log_root_two_pi - std::log(-z) + std::log1p(-square * (1.0 - 3.0 * square));
}

struct TimeMoments {
    double mean = 0.0, sd = 0.0, skewness = 0.0;
};

TimeMoments time_moments(std::span<const double> times) {
    TimeMoments found;
    const auto n = static_cast<double>(times.size());
    for (const double one : times)
        found.mean += one / n;
    double second = 0.0, third = 0.0;
    for (const double one : times) {
        const double off = one - found.mean;
        second += off * off / n;
        third += off * off * off / n;
    }
    found.sd = std::sqrt(second);
    found.skewness = second > 0.0 ? third / std::pow(second, 1.5) : 0.0;
    return found;
}

using Simplex3 = std::array<double, 3>;

/// The least value of a function of three numbers, after Nelder and Mead.
template <class Function> Simplex3 least_of(const Function& of, Simplex3 start, const Simplex3& strides) {
    struct Corner {
        Simplex3 at;
        double value;
    };
    const auto between = [](const Simplex3& one, const Simplex3& other, double part) {
        Simplex3 at;
        for (std::size_t i = 0; i < 3; ++i)
            at[i] = one[i] + part * (other[i] - one[i]);
        return at;
    };
    std::array<Corner, 4> corners;
    corners[0] = {start, of(start)};
    for (std::size_t i = 0; i < 3; ++i) {
        Simplex3 at = start;
        at[i] += strides[i];
        corners[i + 1] = {at, of(at)};
    }
    for (int round = 0; round < 1000; ++round) {
        std::ranges::sort(corners, {}, &Corner::value);
        if (std::abs(corners[3].value - corners[0].value) < 1e-11 * (1.0 + std::abs(corners[0].value)))
            break;
        Simplex3 centre{};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < 3; ++i)
                centre[i] += corners[c].at[i] / 3.0;
        const auto try_at = [&](double part) {
            const Simplex3 at = between(centre, corners[3].at, part);
            return Corner{at, of(at)};
        };
        const Corner reflected = try_at(-1.0);
        if (reflected.value < corners[0].value) {
            const Corner expanded = try_at(-2.0);
            corners[3] = expanded.value < reflected.value ? expanded : reflected;
        } else if (reflected.value < corners[2].value) {
            corners[3] = reflected;
        } else {
            const Corner inner = reflected.value < corners[3].value ? try_at(-0.5) : try_at(0.5);
            if (inner.value < std::min(reflected.value, corners[3].value)) {
                corners[3] = inner;
            } else {
                for (std::size_t c = 1; c < 4; ++c) {
                    corners[c].at = between(corners[0].at, corners[c].at, 0.5);
                    corners[c].value = of(corners[c].at);
                }
            }
        }
    }
    return std::ranges::min_element(corners, {}, &Corner::value)->at;
}

/// With the shift held: mu and sigma are those of the logarithms.
ShiftedLogNormal log_normal_beyond(std::span<const double> times, double shift) {
    ShiftedLogNormal fit;
    fit.shift = shift;
    const auto n = static_cast<double>(times.size());
    for (const double one : times)
        fit.mu += std::log(one - shift) / n;
    double squares = 0.0;
    for (const double one : times)
        squares += std::pow(std::log(one - shift) - fit.mu, 2);
    fit.sigma = std::sqrt(squares / n);
    for (const double one : times)
        fit.log_likelihood += fit.log_density(one);
    return fit;
}

} // namespace

double ExGaussian::log_density(double time) const {
    const double z = (time - mu) / sigma - sigma / tau;
    return -std::log(tau) + 0.5 * sigma * sigma / (tau * tau) - (time - mu) / tau + log_normal_probability(z);
}

double ShiftedLogNormal::log_density(double time) const {
    if (time <= shift)
        return -std::numeric_limits<double>::infinity();
    const double z = (std::log(time - shift) - mu) / sigma;
    return -log_root_two_pi - std::log(sigma) - std::log(time - shift) - 0.5 * z * z;
}

std::optional<ExGaussian> fit_ex_gaussian(std::span<const double> times) {
    const TimeMoments moments = time_moments(times);
    if (times.size() < least_times || !(moments.sd > least_spread * std::abs(moments.mean)))
        return std::nullopt;
    // Moments of the distribution: variance sigma^2 + tau^2, skewness 2 (tau / sd)^3.
    const double part = std::clamp(std::cbrt(std::max(moments.skewness, 0.0) / 2.0), 0.2, 0.95);
    const auto fit_at = [](const Simplex3& at) {
        return ExGaussian{at[0], std::exp(at[1]), std::exp(at[2])};
    };
    const auto minus_log = [&](const Simplex3& at) {
        const ExGaussian fit = fit_at(at);
        double sum = 0.0;
        for (const double one : times)
            sum -= fit.log_density(one);
        return std::isfinite(sum) ? sum : std::numeric_limits<double>::max();
    };
    Simplex3 start{moments.mean - part * moments.sd, std::log(moments.sd * std::sqrt(1.0 - part * part)),
                   std::log(part * moments.sd)};
    const Simplex3 strides{0.2 * moments.sd, 0.3, 0.3};
    for (int again = 0; again < 3; ++again) // from where it stopped, since a simplex can collapse too early
        start = least_of(minus_log, start, strides);
    ExGaussian fit = fit_at(start);
    fit.log_likelihood = -minus_log(start);
    return fit;
}

std::optional<ShiftedLogNormal> fit_shifted_log_normal(std::span<const double> times) {
    const TimeMoments moments = time_moments(times);
    if (times.size() < least_times || !(moments.sd > least_spread * std::abs(moments.mean)))
        return std::nullopt;
    // Shifts by the logarithm of their distance from the smallest time, from far below it to close.
    const double smallest = *std::ranges::min_element(times);
    const auto at = [&](double log_gap) {
        return log_normal_beyond(times, smallest - moments.sd * std::exp(log_gap));
    };
    constexpr double from = 4.0, step = -0.05;
    constexpr int places = 200;
    std::optional<double> best;
    double best_value = 0.0, before = at(from).log_likelihood, here = at(from + step).log_likelihood;
    for (int i = 2; i < places; ++i) {
        const double next = at(from + i * step).log_likelihood;
        if (here > before && here >= next && (!best || here > best_value)) {
            best = from + (i - 1) * step;
            best_value = here;
        }
        before = here;
        here = next;
    }
    if (!best)
        return std::nullopt;
    constexpr double golden = 0.6180339887498949;
    double low = *best + step, high = *best - step;
    for (int i = 0; i < 60; ++i) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        (at(left).log_likelihood < at(right).log_likelihood ? low : high) =
            at(left).log_likelihood < at(right).log_likelihood ? left : right;
    }
    return at(0.5 * (low + high));
}

} // namespace overt
