#include "experiment/fits/answer_curve.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "experiment/statistics/distributions.h"

namespace overt {

CurveValue curve_at(CurveShape shape, double u) {
    CurveValue at;
    switch (shape) {
    case CurveShape::weibull: {
        const double power = std::exp(u);
        at.rest = std::exp(-power);
        at.value = -std::expm1(-power);
        at.first = at.rest > 0.0 ? power * at.rest : 0.0;
        at.second = at.rest > 0.0 ? at.first * (1.0 - power) : 0.0;
        break;
    }
    case CurveShape::logistic:
        at.value = 1.0 / (1.0 + std::exp(-u));
        at.rest = 1.0 / (1.0 + std::exp(u));
        at.first = at.value * at.rest;
        at.second = at.first * (at.rest - at.value);
        break;
    case CurveShape::normal:
        at.value = normal_probability(u);
        at.rest = normal_probability(-u);
        at.first = std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi);
        at.second = at.first > 0.0 ? -u * at.first : 0.0;
        break;
    }
    return at;
}

double curve_inverse(CurveShape shape, double share) {
    switch (shape) {
    case CurveShape::weibull:
        return std::log(-std::log1p(-share));
    case CurveShape::logistic:
        return std::log(share / (1.0 - share));
    case CurveShape::normal:
        return normal_quantile(share);
    }
    return 0.0;
}

double curve_abscissa(CurveShape shape, double x) {
    if (shape != CurveShape::weibull)
        return x;
    return x > 0.0 ? std::log(x) : -std::numeric_limits<double>::infinity();
}

double curve_level(CurveShape shape, double abscissa) {
    return shape == CurveShape::weibull ? std::exp(abscissa) : abscissa;
}

double curve_share(CurveShape shape, double x, double alpha, double beta) {
    if (shape == CurveShape::weibull)
        return x > 0.0 ? -std::expm1(-std::pow(x / alpha, beta)) : 0.0;
    return curve_at(shape, beta * (x - alpha)).value;
}

} // namespace overt
