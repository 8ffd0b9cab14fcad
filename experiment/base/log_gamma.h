/// The logarithm of the gamma function, from any thread.
#pragma once

#include <cmath>

namespace overt {

/// Of x > 0. std::lgamma() writes the sign into a variable that all threads share.
inline double log_gamma(double x) {
    int sign = 0;
    return ::lgamma_r(x, &sign);
}

} // namespace overt
