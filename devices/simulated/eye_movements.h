/// How eyes move and close, as formulas of time: no state, so that a gaze can be asked for at any instant.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "experiment/base/random.h"
#include "experiment/session_time.h"
#include "experiment/units.h"

namespace overt {

/// exp(normal) with the given median and standard deviation of the logarithm, drawn again until it lies
/// within low … high.
double log_normal_within(RandomStream& random, double median, double log_sd, double low, double high);

/// The eye's small wandering during fixation: slow drift (below 3 Hz) and tremor (about 85 Hz), each a sum of
/// sinusoids. Martinez-Conde, Macknik and Hubel, Nature Reviews Neuroscience 5, 2004.
class FixationalMotion {
  public:
    /// Standard deviations along each axis, of the whole.
    FixationalMotion(std::uint64_t seed, Degrees drift, Degrees tremor);

    /// Displacement in degrees, x to the right, y down.
    glm::dvec2 displacement_deg(SessionTime time) const noexcept;

  private:
    struct Wave {
        double amplitude_deg, frequency_hz, phase_rad;
    };
    static constexpr std::size_t drift_waves = 5, tremor_waves = 2;
    std::array<std::array<Wave, drift_waves + tremor_waves>, 2> waves_{}; ///< of x and of y
};

/// When the eye is closed. One blink falls anywhere into each stretch of 60 s / rate: blinks are more regular
/// than chance.
class BlinkTrain {
  public:
    /// No blinks at a rate of 0.
    BlinkTrain(std::uint64_t seed, double blinks_per_minute) : seed_(seed), rate_(blinks_per_minute) {}

    bool eye_closed_at(SessionTime time) const noexcept;

  private:
    std::uint64_t seed_;
    double rate_;
};

} // namespace overt
