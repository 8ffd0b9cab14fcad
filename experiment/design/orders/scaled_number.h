/// Positive numbers without end: how many orders there are of 300 trials is beyond any double.
#pragma once

#include <cmath>
#include <cstdint>

namespace overt {

/// mantissa * 2^exponent with the precision of a double. Zero has mantissa 0.
struct ScaledNumber {
    double mantissa = 0.0; ///< 0, or 0.5 … 1
    std::int64_t exponent = 0;

    static ScaledNumber of(double value) {
        int exponent = 0;
        const double mantissa = std::frexp(value, &exponent);
        return {mantissa, exponent};
    }
    bool is_zero() const { return mantissa == 0.0; }

    ScaledNumber& operator+=(const ScaledNumber& other) {
        if (other.is_zero())
            return *this;
        if (is_zero() || exponent < other.exponent) {
            const ScaledNumber smaller = *this;
            *this = other;
            return smaller.is_zero() ? *this : *this += smaller;
        }
        const std::int64_t shift = exponent - other.exponent;
        if (shift > 64)
            return *this;
        ScaledNumber sum = of(mantissa + std::ldexp(other.mantissa, -static_cast<int>(shift)));
        sum.exponent += exponent;
        return *this = sum;
    }
    friend ScaledNumber operator*(const ScaledNumber& number, double factor) {
        ScaledNumber product = of(number.mantissa * factor);
        product.exponent += product.is_zero() ? 0 : number.exponent;
        return product;
    }
    /// Natural logarithm; minus infinity of zero.
    double log() const { return std::log(mantissa) + static_cast<double>(exponent) * std::log(2.0); }

    /// *this / other as a double; 0 where it is too small. `other` is not zero.
    double over(const ScaledNumber& other) const {
        const std::int64_t shift = exponent - other.exponent;
        if (is_zero() || shift < -1000)
            return 0.0;
        return std::ldexp(mantissa / other.mantissa, static_cast<int>(shift));
    }
};

} // namespace overt
