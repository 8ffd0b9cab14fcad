/// Probabilities and quantiles of the normal and of Student's distribution.
#pragma once

namespace overt {

/// Probability of a standard normal number up to x.
double normal_probability(double x);

/// The x up to which a standard normal number lies with probability p, 0 < p < 1; else infinite. To about
/// 1e-15 of itself: Wichura's algorithm AS 241 (PPND16), Applied Statistics 37(3), 1988, 477-484.
double normal_quantile(double p);

/// Probability of a number of Student's distribution with `degrees` > 0 of freedom up to t.
double student_probability(double t, double degrees);

/// The t up to which such a number lies with probability p, 0 < p < 1.
double student_quantile(double p, double degrees);

/// Probability of a number of the noncentral distribution of Student's t up to t: of (z + noncentrality) /
/// root (chi-square / degrees). To about 1e-9; `degrees` >= 1.
double noncentral_student_probability(double t, double degrees, double noncentrality);

} // namespace overt
