#include "render/bake/conductor.h"

#include <algorithm>
#include <cmath>

namespace overt {

double conductor_fresnel(double n, double k, double cosine) {
    const double c2 = cosine * cosine, s2 = 1.0 - c2;
    const double t = n * n - k * k - s2;
    const double q = std::sqrt(t * t + 4.0 * n * n * k * k); // a^2 + b^2
    const double a = std::sqrt(std::max(0.0, 0.5 * (q + t)));
    const double across = (q + c2 - 2.0 * a * cosine) / (q + c2 + 2.0 * a * cosine);
    const double along =
        across * (c2 * q + s2 * s2 - 2.0 * a * cosine * s2) / (c2 * q + s2 * s2 + 2.0 * a * cosine * s2);
    return 0.5 * (across + along);
}

float dielectric_fresnel(float ior, float cosine) {
    const float beyond_squared = 1.0f - (1.0f - cosine * cosine) / (ior * ior);
    if (beyond_squared <= 0.0f)
        return 1.0f;
    const float beyond = std::sqrt(beyond_squared);
    const float across = (cosine - ior * beyond) / (cosine + ior * beyond);
    const float along = (ior * cosine - beyond) / (ior * cosine + beyond);
    return 0.5f * (across * across + along * along);
}

ConductorTable::ConductorTable(const std::function<Bins(double)>& reflectance) {
    for (int row = 0; row < rows; ++row)
        reflectance_.push_back(reflectance(static_cast<double>(row) / (rows - 1)));
}

ConductorTable::ConductorTable(const ComplexIndex& metal, double outside)
    : reflectance_(static_cast<std::size_t>(rows)) {
    for (std::size_t row = 0; row < reflectance_.size(); ++row) {
        const double cosine = static_cast<double>(row) / (rows - 1);
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            reflectance_[row].value[bin] =
                static_cast<float>(conductor_fresnel(metal.n[bin] / outside, metal.k[bin] / outside, cosine));
        }
    }
}

} // namespace overt
