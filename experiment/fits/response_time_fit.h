/// Distributions of response times by maximum likelihood.
#pragma once

#include <optional>
#include <span>

namespace overt {

/// A normal number plus an exponential one. Times in any unit.
struct ExGaussian {
    double mu = 0.0, sigma = 1.0, tau = 1.0;
    double log_likelihood = 0.0;
    double log_density(double time) const;
    double mean() const { return mu + tau; }
};

/// shift + exp(normal with mean mu and standard deviation sigma of logarithms).
struct ShiftedLogNormal {
    double shift = 0.0, mu = 0.0, sigma = 1.0;
    double log_likelihood = 0.0;
    double log_density(double time) const; ///< minus infinity at or below the shift
};

/// By the simplex of Nelder and Mead (1965) on mu, log sigma, log tau, from the moments. Nothing with fewer
/// than ten times, or if all are alike.
std::optional<ExGaussian> fit_ex_gaussian(std::span<const double> times);

/// The likelihood grows without bound as the shift comes to the smallest time; what is meant is its highest
/// maximum below that. Nothing with fewer than ten times, or where there is no such maximum.
std::optional<ShiftedLogNormal> fit_shifted_log_normal(std::span<const double> times);

} // namespace overt
