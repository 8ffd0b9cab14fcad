/// How long heat is to flow, made of equal implicit steps.
#pragma once

#include <vector>

namespace overt {

/// An implicit step of length tau multiplies a mode that decays with the rate r by 1 / (1 + tau r), which is
/// the mean of exp(-r s) over times s that are exponentially distributed with mean tau. Sums of products of
/// such steps are means over other distributions of s. As long as a distribution is nowhere negative, so is
/// what it makes of something that is nowhere negative, on any surface; and the narrower it is, the nearer is
/// its mean to the flow of one time. n steps in a row give the gamma distribution, with the relative variance
/// 1 / n. A density exp(-s / tau) q(s / tau)^2, with a polynomial q of degree m, takes 2 m + 1 steps and is
/// nowhere negative either; the q that makes the variance least is an eigenvector of a small matrix, and the
/// relative variance falls with the square of the number of steps: 29 steps do for what takes 100 in a row.
///
/// A mean over times t (1 ± w) makes the value of a Gaussian at its centre w^2 higher, moves the share 0.4
/// w^2 of its mass, and leaves its variance as it is.
class HeatTimes {
  public:
    /// Steps: one more than twice the degree of q.
    static constexpr int degree = 14;
    static constexpr int steps = 2 * degree + 1;

    /// For times from `longest` / 36 up to `longest` > 0; those below `longest` / 2.6 come out less narrow.
    explicit HeatTimes(double longest);

    /// Of one implicit step.
    double step() const { return step_; }

    /// Weights c[0] … c[steps - 1] such that the mean over times of exp(-r s) is x times the sum of
    /// c[k] T_k(2 x - 1), with x = 1 / (1 + tau r) for a step and Chebyshev's polynomials T_k. Their sum
    /// is 1. (As sums of powers of x the same would have weights of 1e10 that cancel.) `time`: step() <= time
    /// <= longest.
    std::vector<double> weights(double time) const;

    /// Variance of the times over the square of their mean.
    double relative_variance(double time) const;

  private:
    /// One density: the mean and the mean square of its times, in steps, and its weights.
    struct Density {
        double mean = 0.0, mean_square = 0.0;
        std::vector<double> weights;
    };
    struct Mixture {
        const Density &first, &second;
        double share_of_second;
    };
    Mixture mixture_for(double time) const;

    double step_;
    std::vector<Density> densities_; ///< by rising mean; mixtures of neighbours are the narrowest there are
};

} // namespace overt
