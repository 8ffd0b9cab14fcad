/// Curves between chance and certainty: the standard shapes of psychometric functions with their derivatives.
#pragma once

#include <cstdint>

#include "experiment/base/enum_names.h"

namespace overt {

/// F of psi(x) = gamma + (1 - gamma - lambda) F(x).
enum class CurveShape : std::uint8_t {
    weibull,  ///< 1 - exp(-(x / alpha)^beta), x >= 0
    logistic, ///< 1 / (1 + exp(-beta (x - alpha)))
    normal    ///< normal probability of beta (x - alpha)
};
template <>
inline constexpr auto names_of<CurveShape> = enum_names<CurveShape>("weibull", "logistic", "normal");

/// The shape over u, a straight line in x or, of Weibull, in log x: value, first and second derivative.
struct CurveValue {
    double value = 0.0, rest = 1.0; ///< F and 1 - F, each exact where it is small
    double first = 0.0, second = 0.0;
};
CurveValue curve_at(CurveShape shape, double u);

/// The u at which F has this value, 0 < share < 1.
double curve_inverse(CurveShape shape, double share);

/// What u is a straight line of: x itself, or log x. Of Weibull x = 0 is minus infinity.
double curve_abscissa(CurveShape shape, double x);
double curve_level(CurveShape shape, double abscissa); ///< the x back again

/// F(x) with these parameters.
double curve_share(CurveShape shape, double x, double alpha, double beta);

} // namespace overt
