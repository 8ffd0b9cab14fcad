#include "devices/simulated/simulated_display.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace overt {

DisplayTruth DisplayTruth::drawn(std::uint64_t seed) {
    RandomStream random(seed, "simulated display");
    const auto around = [&](double value, double share) {
        return value * random.uniform(1.0 - share, 1.0 + share);
    };
    DisplayTruth truth;
    // Red, green and blue of a usual gamut, 100 cd/m2 together.
    const std::array<glm::dvec3, 3> usual{glm::dvec3(43.0, 22.5, 2.1), glm::dvec3(35.0, 70.0, 11.5),
                                          glm::dvec3(18.5, 7.5, 97.0)};
    for (std::size_t i = 0; i < 3; ++i) {
        const double brightness = around(1.0, 0.1);
        for (int axis = 0; axis < 3; ++axis)
            truth.primaries_xyz[i][axis] = brightness * around(usual[i][axis], 0.03);
        truth.exponents[i] = random.uniform(1.9, 2.5);
        truth.offsets[i] = random.uniform(-0.02, 0.01);
        truth.shoulders[i] = random.uniform(-0.15, 0.15);
    }
    truth.black_xyz = glm::dvec3(around(0.1, 0.3), around(0.11, 0.3), around(0.17, 0.3));
    return truth;
}

glm::dvec3 DisplayTruth::xyz_of(const glm::dvec3& signal) const {
    glm::dvec3 light(0.0);
    for (int channel = 0; channel < 3; ++channel) {
        const auto i = static_cast<std::size_t>(channel);
        const double s = std::clamp(signal[channel], 0.0, 1.0);
        const auto power = [&](double at) {
            return std::pow(std::max(0.0, (1.0 - offsets[i]) * at + offsets[i]), exponents[i]);
        };
        const double dark = power(0.0);
        light[channel] = (power(s) - dark) / (1.0 - dark) * (1.0 + shoulders[i] * s * (1.0 - s));
    }
    glm::dvec3 xyz = black_xyz;
    for (int channel = 0; channel < 3; ++channel) {
        const double others = light.x + light.y + light.z - light[channel];
        xyz += light[channel] * (1.0 - 0.5 * crosstalk * others) *
               primaries_xyz[static_cast<std::size_t>(channel)];
    }
    return xyz;
}

glm::dvec3 SimulatedPhotometer::measure_xyz(const glm::dvec3& signal) {
    glm::dvec3 xyz = truth_.xyz_of(signal);
    for (int axis = 0; axis < 3; ++axis)
        xyz[axis] *= 1.0 + truth_.reading_noise * noise_.normal();
    for (int axis = 0; axis < 3; ++axis)
        xyz[axis] += truth_.dark_noise_cd_m2 * noise_.normal();
    return glm::max(xyz, glm::dvec3(0.0));
}

} // namespace overt
