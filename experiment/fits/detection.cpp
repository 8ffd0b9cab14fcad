#include "experiment/fits/detection.h"

#include <cmath>
#include <numbers>

#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

double corrected(double count, double of, ShareCorrection correction) {
    switch (correction) {
    case ShareCorrection::none:
        break;
    case ShareCorrection::log_linear:
        return (count + 0.5) / (of + 1.0);
    case ShareCorrection::extreme:
        if (count <= 0.0)
            return 0.5 / of;
        if (count >= of)
            return 1.0 - 0.5 / of;
        break;
    }
    return count / of;
}

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

/// Integral of `of` by Simpson's rule over equal steps, as many as are even.
template <class Function> double integral(double from, double to, int steps, const Function& of) {
    const double step = (to - from) / steps;
    double sum = of(from) + of(to);
    for (int i = 1; i < steps; ++i)
        sum += (i % 2 == 1 ? 4.0 : 2.0) * of(from + i * step);
    return sum * step / 3.0;
}

/// The d' from 0 to 40 at which a rising curve has this value.
template <class Curve> std::optional<double> rising_inverse(double value, const Curve& curve) {
    if (value <= curve(0.0))
        return 0.0;
    double low = 0.0, high = 1.0;
    while (curve(high) < value) {
        high *= 2.0;
        if (high > 40.0)
            return std::nullopt;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (curve(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace

DetectionEstimate yes_no(const DetectionCounts& counts, ShareCorrection correction) {
    const double signals = counts.hits + counts.misses,
                 noises = counts.false_alarms + counts.correct_rejections;
    const double hit = corrected(counts.hits, signals, correction);
    const double alarm = corrected(counts.false_alarms, noises, correction);
    const double z_hit = normal_quantile(hit), z_alarm = normal_quantile(alarm);
    DetectionEstimate found{z_hit - z_alarm, -0.5 * (z_hit + z_alarm), 0.0};
    found.log_beta = found.criterion * found.d_prime;
    if (std::isfinite(z_hit) && std::isfinite(z_alarm))
        found.se = std::sqrt(hit * (1.0 - hit) / (signals * std::pow(density(z_hit), 2)) +
                             alarm * (1.0 - alarm) / (noises * std::pow(density(z_alarm), 2)));
    return found;
}

DetectionEstimate two_alternatives(const DetectionCounts& counts, ShareCorrection correction) {
    DetectionEstimate found = yes_no(counts, correction);
    found.d_prime /= std::numbers::sqrt2;
    found.log_beta = found.criterion * found.d_prime;
    if (found.se)
        *found.se /= std::numbers::sqrt2;
    return found;
}

double correct_share(DetectionDesign design, double d, int alternatives) {
    constexpr double sqrt2 = std::numbers::sqrt2;
    const double sqrt6 = std::sqrt(6.0);
    const auto both = [](double one, double other) {
        return normal_probability(one) * normal_probability(other) +
               normal_probability(-one) * normal_probability(-other);
    };
    switch (design) {
    case DetectionDesign::yes_no:
        return normal_probability(0.5 * d);
    case DetectionDesign::alternatives:
        return integral(d - 9.0, d + 9.0, 720, [&](double x) {
            return density(x - d) * std::pow(normal_probability(x), alternatives - 1);
        });
    case DetectionDesign::abx_differencing:
        return both(d / sqrt2, d / sqrt6);
    case DetectionDesign::abx_independent:
        return both(d / sqrt2, 0.5 * d);
    case DetectionDesign::same_different_independent:
        return both(0.5 * d, 0.5 * d);
    case DetectionDesign::oddity: {
        const double shift = d * std::sqrt(2.0 / 3.0), sqrt3 = std::numbers::sqrt3;
        return 2.0 * integral(0.0, 9.0, 1440, [&](double x) {
                   return (normal_probability(-x * sqrt3 + shift) + normal_probability(-x * sqrt3 - shift)) *
                          density(x);
               });
    }
    }
    return 0.0;
}

double same_different_hits(double d_prime, double false_alarms) {
    const double k = std::numbers::sqrt2 * normal_quantile(0.5 * false_alarms);
    return normal_probability((k + d_prime) / std::numbers::sqrt2) +
           normal_probability((k - d_prime) / std::numbers::sqrt2);
}

std::optional<double> d_prime_of_share(DetectionDesign design, double share, int alternatives) {
    if (share >= 1.0)
        return std::nullopt;
    return rising_inverse(share, [&](double d) { return correct_share(design, d, alternatives); });
}

std::optional<double> d_prime_same_different(double hits, double false_alarms) {
    if (hits >= 1.0 || !(false_alarms > 0.0 && false_alarms < 1.0))
        return std::nullopt;
    return rising_inverse(hits, [&](double d) { return same_different_hits(d, false_alarms); });
}

std::optional<DesignEstimate> estimate_d_prime(DetectionDesign design, double correct, double trials,
                                               ShareCorrection correction, int alternatives) {
    const double share = corrected(correct, trials, correction);
    const std::optional<double> d_prime = d_prime_of_share(design, share, alternatives);
    if (!d_prime)
        return std::nullopt;
    DesignEstimate found{*d_prime};
    if (*d_prime > 0.0) {
        constexpr double step = 1e-4;
        const double from = std::max(*d_prime - step, 0.0), to = *d_prime + step;
        const double slope =
            (correct_share(design, to, alternatives) - correct_share(design, from, alternatives)) /
            (to - from);
        found.se = std::sqrt(share * (1.0 - share) / trials) / slope;
    }
    return found;
}

} // namespace overt
