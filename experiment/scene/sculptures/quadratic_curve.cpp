#include "experiment/scene/sculptures/quadratic_curve.h"

#include <algorithm>
#include <cmath>

namespace overt {

double QuadraticCurve::nearest(const glm::dvec3& point) const {
    // (B(t) - p) . B'(t) = 0 is a cubic in t; B(t) = a + 2 t u + t^2 w.
    const glm::dvec3 u = control - a;
    const glm::dvec3 w = b - control - u;
    const glm::dvec3 d = a - point;
    const double uu = glm::dot(u, u);
    const double ww = glm::dot(w, w);
    if (ww < 1e-6 * uu)
        return std::clamp(-glm::dot(d, u) / (2.0 * uu), 0.0, 1.0);
    const double k2 = glm::dot(u, w) / ww;
    const double k1 = (2.0 * uu + glm::dot(d, w)) / (3.0 * ww);
    const double k0 = glm::dot(d, u) / ww;
    // s = t + k2 makes the cubic s^3 + 3 p s + q = 0.
    const double p = k1 - k2 * k2;
    const double q = k2 * (2.0 * k2 * k2 - 3.0 * k1) + k0;
    const double discriminant = q * q + 4.0 * p * p * p;
    if (discriminant >= 0.0) {
        const double root = std::sqrt(discriminant);
        return std::clamp(std::cbrt(0.5 * (-q + root)) + std::cbrt(0.5 * (-q - root)) - k2, 0.0, 1.0);
    }
    const double z = std::sqrt(-p);
    const double third = std::acos(std::clamp(q / (2.0 * p * z), -1.0, 1.0)) / 3.0;
    const double cosine = std::cos(third);
    const double sine = std::sin(third) * std::sqrt(3.0);
    // The greatest and the least root are minima of the distance; the one between is a maximum.
    const double t0 = std::clamp(2.0 * cosine * z - k2, 0.0, 1.0);
    const double t1 = std::clamp((-cosine - sine) * z - k2, 0.0, 1.0);
    const glm::dvec3 to0 = at(t0) - point;
    const glm::dvec3 to1 = at(t1) - point;
    return glm::dot(to0, to0) <= glm::dot(to1, to1) ? t0 : t1;
}

} // namespace overt
