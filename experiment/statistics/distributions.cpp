#include "experiment/statistics/distributions.h"
#include "experiment/base/log_gamma.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace overt {

namespace {

/// Polynomial with the constant first, after Horner.
template <std::size_t N> double polynomial(const std::array<double, N>& of, double x) {
    double sum = 0.0;
    for (std::size_t i = N; i-- > 0;)
        sum = sum * x + of[i];
    return sum;
}

// Coefficients as printed in AS 241.
constexpr std::array as241_a{3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                             1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                             3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr std::array as241_b{1.0,
                             4.2313330701600911252e+1,
                             6.8718700749205790830e+2,
                             5.3941960214247511077e+3,
                             2.1213794301586595867e+4,
                             3.9307895800092710610e+4,
                             2.8729085735721942674e+4,
                             5.2264952788528545610e+3};
constexpr std::array as241_c{1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                             3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr std::array as241_d{1.0,
                             2.05319162663775882187e0,
                             1.67638483018380384940e0,
                             6.89767334985100004550e-1,
                             1.48103976427480074590e-1,
                             1.51986665636164571966e-2,
                             5.47593808499534494600e-4,
                             1.05075007164441684324e-9};
constexpr std::array as241_e{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                             2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                             2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array as241_f{1.0,
                             5.99832206555887937690e-1,
                             1.36929880922735805310e-1,
                             1.48753612908506148525e-2,
                             7.86869131145613259100e-4,
                             1.84631831751005468180e-5,
                             1.42151175831644588870e-7,
                             2.04426310338993978564e-15};

/// The continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by Lentz's method.
double beta_fraction(double p, double q, double x) {
    constexpr double least = 1e-300;
    double up = 1.0, down = 1.0 - (p + q) * x / (p + 1.0);
    down = 1.0 / (std::abs(down) < least ? least : down);
    double value = down;
    for (int m = 1; m < 1000; ++m) {
        const double even = m * (q - m) * x / ((p + 2 * m - 1) * (p + 2 * m));
        const double odd = -(p + m) * (p + q + m) * x / ((p + 2 * m) * (p + 2 * m + 1));
        double change = 1.0;
        for (const double step : {even, odd}) {
            down = 1.0 + step * down;
            down = 1.0 / (std::abs(down) < least ? least : down);
            up = 1.0 + step / up;
            up = std::abs(up) < least ? least : up;
            change = up * down;
            value *= change;
        }
        if (std::abs(change - 1.0) < 1e-16)
            break;
    }
    return value;
}

double incomplete_beta(double p, double q, double x) {
    if (x <= 0.0)
        return 0.0;
    if (x >= 1.0)
        return 1.0;
    const double front =
        std::exp(log_gamma(p + q) - log_gamma(p) - log_gamma(q) + p * std::log(x) + q * std::log1p(-x));
    return x < (p + 1.0) / (p + q + 2.0) ? front * beta_fraction(p, q, x) / p
                                         : 1.0 - front * beta_fraction(q, p, 1.0 - x) / q;
}

} // namespace

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double normal_quantile(double p) {
    const double q = p - 0.5;
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(as241_a, r) / polynomial(as241_b, r);
    }
    double r = q < 0.0 ? p : 1.0 - p;
    if (!(r > 0.0))
        return std::copysign(std::numeric_limits<double>::infinity(), q);
    r = std::sqrt(-std::log(r));
    const double tail = r <= 5.0 ? polynomial(as241_c, r - 1.6) / polynomial(as241_d, r - 1.6)
                                 : polynomial(as241_e, r - 5.0) / polynomial(as241_f, r - 5.0);
    return std::copysign(tail, q);
}

double student_probability(double t, double degrees) {
    const double tail = 0.5 * incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
    return t > 0.0 ? 1.0 - tail : tail;
}

double student_quantile(double p, double degrees) {
    if (p == 0.5)
        return 0.0;
    // The tail's probability falls with t: halve an interval that holds it until nothing is between.
    const double tail = p < 0.5 ? p : 1.0 - p;
    double low = 0.0, high = 1.0;
    while (student_probability(-high, degrees) > tail && high < 1e300)
        high *= 2.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high)
            break;
        (student_probability(-middle, degrees) > tail ? low : high) = middle;
    }
    return std::copysign(0.5 * (low + high), p - 0.5);
}

double noncentral_student_probability(double t, double degrees, double noncentrality) {
    // Given u = root (chi-square / degrees), t is not exceeded where z is at most t u - noncentrality.
    const double log_front =
        std::log(2.0) + 0.5 * degrees * std::log(0.5 * degrees) - log_gamma(0.5 * degrees);
    const auto density = [&](double u) {
        return u > 0.0          ? std::exp(log_front + (degrees - 1.0) * std::log(u) - 0.5 * degrees * u * u)
               : degrees == 1.0 ? std::exp(log_front)
                                : 0.0;
    };
    const auto value = [&](double u) { return density(u) * normal_probability(t * u - noncentrality); };
    // Beyond ten standard deviations, 1 / root (2 degrees) each, nothing is left.
    const double deviation = 1.0 / std::sqrt(2.0 * degrees);
    const double from = std::max(0.0, 1.0 - 10.0 * deviation), to = 1.0 + 10.0 * deviation;
    // Fine enough for where t u passes the noncentrality, within 1 / |t|.
    const int steps = 2 * std::clamp(static_cast<int>(4.0 * std::abs(t) * (to - from)), 200, 20000);
    const double step = (to - from) / steps;
    double sum = value(from) + value(to);
    for (int i = 1; i < steps; ++i)
        sum += (i % 2 == 1 ? 4.0 : 2.0) * value(from + i * step);
    return std::clamp(sum * step / 3.0, 0.0, 1.0);
}

} // namespace overt
