/// A display that is not there, and the photometer before it: their truth is known, so that what a
/// characterisation finds can be held against it.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "experiment/base/random.h"

namespace overt {

/// What the light of the display is made of.
struct DisplayTruth {
    glm::dvec3 black_xyz{0.0};                 ///< cd/m2
    std::array<glm::dvec3, 3> primaries_xyz{}; ///< of the channels at full signal, without the black
    std::array<double, 3> exponents{2.2, 2.2, 2.2};
    std::array<double, 3> offsets{};   ///< of a power, as ChannelCurve has it
    std::array<double, 3> shoulders{}; ///< how far a curve bends away from its power
    /// By this share a channel's light sinks when the two others are fully lit.
    double crosstalk = 0.0;
    double reading_noise = 0.001;    ///< standard deviation of a reading, as share of it
    double dark_noise_cd_m2 = 0.002; ///< and what there is of it without light

    /// A white-LED display like many, a little different for each seed.
    static DisplayTruth drawn(std::uint64_t seed);

    /// XYZ in cd/m2 at a signal of 0 … 1 in red, green and blue.
    glm::dvec3 xyz_of(const glm::dvec3& signal) const;
};

/// Reads the light of such a display, with noise. One thread.
class SimulatedPhotometer {
  public:
    SimulatedPhotometer(const DisplayTruth& truth, std::uint64_t seed)
        : truth_(truth), noise_(seed, "photometer noise") {}

    glm::dvec3 measure_xyz(const glm::dvec3& signal);

  private:
    DisplayTruth truth_;
    RandomStream noise_;
};

} // namespace overt
