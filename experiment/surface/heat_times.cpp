#define EIGEN_MPL2_ONLY
#include "experiment/surface/heat_times.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Where the longest time lies, in steps and multiples of the degree: later the polynomial runs out of zeros
/// that it could place between the times that it is to keep away from.
constexpr double longest_by_degree = 2.6;
/// How finely the mean times are scanned for densities.
constexpr int scanned = 400;

/// Multiplication with s in the orthonormal Laguerre polynomials.
Eigen::MatrixXd times_s(int size) {
    Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(size, size);
    for (int k = 0; k < size; ++k) {
        jacobi(k, k) = 2.0 * k + 1.0;
        if (k > 0)
            jacobi(k, k - 1) = jacobi(k - 1, k) = -k;
    }
    return jacobi;
}

/// The sum of the polynomials L_0 … L_(n-1) with n weights, at s.
double laguerre_sum(const Eigen::VectorXd& weights, double s) {
    double before = 0.0, value = 1.0, sum = 0.0;
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
        sum += weights(k) * value;
        const auto order = static_cast<double>(k);
        const double next = ((2.0 * order + 1.0 - s) * value - order * before) / (order + 1.0);
        before = value;
        value = next;
    }
    return sum;
}

/// Gauss's quadrature of exp(-s) f(s) over s >= 0, exact for polynomials up to degree 2 points - 1.
struct LaguerreQuadrature {
    Eigen::VectorXd places, weights;

    explicit LaguerreQuadrature(int points)
        : places(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(times_s(points)).eigenvalues()),
          weights(points) {
        for (int i = 0; i < points; ++i) {
            // Christoffel's number: one over the sum of the squared polynomials.
            double before = 0.0, value = 1.0, sum = 0.0;
            for (int k = 0; k < points; ++k) {
                sum += value * value;
                const double next = ((2.0 * k + 1.0 - places(i)) * value - k * before) / (k + 1.0);
                before = value;
                value = next;
            }
            weights(i) = 1.0 / sum;
        }
    }
};

} // namespace

HeatTimes::HeatTimes(double longest) : step_(longest / (longest_by_degree * degree)) {
    OVERT_EXPECTS(longest > 0.0);
    constexpr int size = degree + 1;
    const LaguerreQuadrature quadrature(size + 2);
    const Eigen::MatrixXd s = times_s(size + 2);
    const Eigen::MatrixXd s_squared = s * s;
    std::vector<Density> found;
    for (int i = 1; i <= scanned; ++i) {
        // The density whose mean square distance from s0 is least.
        const double s0 = 1.2 * longest_by_degree * degree * i / scanned;
        const Eigen::MatrixXd spread =
            (s_squared - 2.0 * s0 * s + s0 * s0 * Eigen::MatrixXd::Identity(size + 2, size + 2))
                .topLeftCorner(size, size);
        const Eigen::VectorXd q =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(spread).eigenvectors().col(0);
        Density density;
        for (Eigen::Index n = 0; n < quadrature.places.size(); ++n) {
            const double value = laguerre_sum(q, quadrature.places(n));
            const double mass = quadrature.weights(n) * value * value;
            density.mean += mass * quadrature.places(n);
            density.mean_square += mass * quadrature.places(n) * quadrature.places(n);
        }
        // With x = 1 / (1 + r), the integral of exp(-s) q(s)^2 exp(-r s) is x times that of exp(-y) q(x y)^2
        // over y: a polynomial in x, whose weights are those of a cosine transform.
        density.weights.assign(steps, 0.0);
        for (int j = 0; j < steps; ++j) {
            const double angle = std::numbers::pi * (j + 0.5) / steps;
            const double x = 0.5 * (1.0 + std::cos(angle));
            double value = 0.0;
            for (Eigen::Index n = 0; n < quadrature.places.size(); ++n) {
                const double root = laguerre_sum(q, x * quadrature.places(n));
                value += quadrature.weights(n) * root * root;
            }
            for (int k = 0; k < steps; ++k)
                density.weights[static_cast<std::size_t>(k)] +=
                    (k == 0 ? 1.0 : 2.0) / steps * value * std::cos(k * angle);
        }
        found.push_back(std::move(density));
    }
    // The shortest of all: a single step.
    found.push_back({1.0, 2.0, std::vector<double>(steps, 0.0)});
    found.back().weights[0] = 1.0;
    std::sort(found.begin(), found.end(), [](const Density& a, const Density& b) { return a.mean < b.mean; });
    // Of mixtures with a given mean, those of neighbours on the lower hull of (mean, mean square) have the
    // least mean square.
    for (Density& next : found) {
        if (next.mean < 1.0)
            continue;
        const auto turns_down = [&] {
            const Density &a = densities_[densities_.size() - 2], &b = densities_.back();
            return (b.mean_square - a.mean_square) * (next.mean - a.mean) >=
                   (next.mean_square - a.mean_square) * (b.mean - a.mean);
        };
        while (densities_.size() >= 2 && turns_down())
            densities_.pop_back();
        densities_.push_back(std::move(next));
    }
}

HeatTimes::Mixture HeatTimes::mixture_for(double time) const {
    const double mean = time / step_;
    OVERT_EXPECTS(mean >= 1.0 && mean <= densities_.back().mean);
    const auto above = std::lower_bound(densities_.begin() + 1, densities_.end(), mean,
                                        [](const Density& d, double wanted) { return d.mean < wanted; });
    const Density &first = *(above - 1), &second = *above;
    return {first, second, (mean - first.mean) / (second.mean - first.mean)};
}

std::vector<double> HeatTimes::weights(double time) const {
    const auto [first, second, share] = mixture_for(time);
    std::vector<double> mixed(steps);
    for (std::size_t k = 0; k < steps; ++k)
        mixed[k] = (1.0 - share) * first.weights[k] + share * second.weights[k];
    return mixed;
}

double HeatTimes::relative_variance(double time) const {
    const auto [first, second, share] = mixture_for(time);
    const double mean = time / step_;
    return ((1.0 - share) * first.mean_square + share * second.mean_square) / (mean * mean) - 1.0;
}

} // namespace overt
