#include "experiment/statistics/paired_evidence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "experiment/base/log_gamma.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// Simpson's rule.
double integral_of(const std::function<double(double)>& function, double from, double to, int steps) {
    const double step = (to - from) / steps;
    double sum = function(from) + function(to);
    for (int i = 1; i < steps; ++i)
        sum += (i % 2 == 1 ? 4.0 : 2.0) * function(from + i * step);
    return sum * step / 3.0;
}

/// Largest effect size that an interval may reach.
constexpr double most_effect = 50.0;

/// The parameter of noncentrality at which t has this probability below it.
double noncentrality_at(double probability, double t, double degrees, double most) {
    double low = -most, high = most;
    for (int i = 0; i < 42; ++i) {
        const double middle = 0.5 * (low + high);
        (noncentral_student_probability(t, degrees, middle) > probability ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Hedges' factor, exactly.
double small_sample_factor(double degrees) {
    return std::exp(log_gamma(0.5 * degrees) - log_gamma(0.5 * (degrees - 1.0))) / std::sqrt(0.5 * degrees);
}

} // namespace

double jzs_bayes_factor(double t, double observers, double scale) {
    const double degrees = observers - 1.0, power = -0.5 * (degrees + 1.0);
    const double without = power * std::log1p(t * t / degrees);
    // Over x = log g; the prior of g is that of the inverse of chi-square with one degree.
    const auto with = [&](double x) {
        const double g = std::exp(x), widened = 1.0 + observers * g * scale * scale;
        const double log_value = -0.5 * std::log(widened) + power * std::log1p(t * t / (widened * degrees)) -
                                 without - 0.5 * std::log(2.0 * std::numbers::pi) - 1.5 * x - 0.5 / g + x;
        return std::exp(log_value);
    };
    return integral_of(with, -8.0, 60.0, 4000);
}

PairedEvidence paired_evidence(std::span<const double> differences, double smallest_effect,
                               double confidence) {
    PairedEvidence evidence;
    evidence.effect_size = Estimate::none("it takes two observers");
    if (differences.size() < 2)
        return evidence;
    const auto n = static_cast<double>(differences.size());
    const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / n;
    double squares = 0.0, size = 0.0;
    for (const double difference : differences) {
        squares += (difference - mean) * (difference - mean);
        size = std::max(size, std::abs(difference));
    }
    const double deviation = std::sqrt(squares / (n - 1.0)), root = std::sqrt(n), degrees = n - 1.0;
    if (!(deviation > 1e-12 * size)) {
        evidence.effect_size = Estimate::none("all observers have the same difference");
        return evidence;
    }
    const double t = mean / deviation * root;
    evidence.bayes_factor = jzs_bayes_factor(t, n);
    const double bound = smallest_effect * root;
    evidence.equivalence_p = std::max(1.0 - noncentral_student_probability(t, degrees, -bound),
                                      noncentral_student_probability(t, degrees, bound));
    if (degrees < 2.0) {
        evidence.effect_size = Estimate::of(t / root);
        return evidence;
    }
    const double factor = small_sample_factor(degrees), outside = 0.5 * (1.0 - confidence);
    evidence.effect_size = Estimate::of(
        factor * t / root, Interval{noncentrality_at(1.0 - outside, t, degrees, most_effect * root) / root,
                                    noncentrality_at(outside, t, degrees, most_effect * root) / root});
    return evidence;
}

} // namespace overt
