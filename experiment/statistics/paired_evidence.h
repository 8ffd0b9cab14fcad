/// What a mean of differences within observers says besides its p: how large it is, and how much speaks for
/// there being none.
#pragma once

#include <optional>
#include <span>

#include "experiment/statistics/estimate.h"

namespace overt {

/// Takes differences for normally distributed over observers.
struct PairedEvidence {
    /// Mean over standard deviation of the differences (Cohen's d_z), times Hedges' correction for small
    /// samples (1981), with the interval of the noncentral t distribution (Steiger and Fouladi 1997).
    Estimate effect_size;
    /// BF10, of an effect against none: the JZS Bayes factor of a paired t test (Rouder, Speckman, Sun, Morey
    /// and Iverson 2009, Psychonomic Bulletin & Review 16, 225-237), with Cauchy's distribution of effect
    /// sizes about 0 of scale root 2 / 2. Below 1/3 it speaks for no effect, above 3 for one.
    std::optional<double> bayes_factor;
    /// p of two one-sided tests (Schuirmann 1987) that the effect size is no smaller than `smallest_effect`
    /// of interest either way: small where the effect is shown to be smaller. Bounds are of d_z, so the tests
    /// are of the noncentral t distribution.
    std::optional<double> equivalence_p;
};

/// Of observers' differences. Absent with fewer than two, and where all are the same. `smallest_effect` > 0.
PairedEvidence paired_evidence(std::span<const double> differences, double smallest_effect,
                               double confidence = 0.95);

/// BF10 of t with n observers (Rouder et al. 2009, equation 1), n >= 2.
double jzs_bayes_factor(double t, double observers, double scale = 0.70710678118654752);

} // namespace overt
