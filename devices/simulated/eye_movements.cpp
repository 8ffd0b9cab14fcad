#include "devices/simulated/eye_movements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

// Source of the range: Stern, Walrath and Goldstein, Psychophysiology 21(1), 1984.
constexpr double shortest_blink_s = 0.1, longest_blink_s = 0.2;

} // namespace

double log_normal_within(RandomStream& random, double median, double log_sd, double low, double high) {
    for (int tries = 0; tries < 1000; ++tries) {
        const double value = median * std::exp(log_sd * random.normal());
        if (value >= low && value <= high)
            return value;
    }
    return std::clamp(median, low, high);
}

FixationalMotion::FixationalMotion(std::uint64_t seed, Degrees drift, Degrees tremor) {
    RandomStream random(seed, "fixational motion");
    for (auto& axis : waves_) {
        for (std::size_t i = 0; i < axis.size(); ++i) {
            const bool slow = i < drift_waves;
            // A sinusoid's standard deviation is its amplitude over the root of 2; variances of the waves
            // add.
            const double amplitude = slow ? drift.value * std::sqrt(2.0 / drift_waves)
                                          : tremor.value * std::sqrt(2.0 / tremor_waves);
            const double frequency = slow ? random.uniform(0.2, 3.0) : random.uniform(70.0, 100.0);
            axis[i] = {amplitude, frequency, random.uniform(0.0, 2.0 * std::numbers::pi)};
        }
    }
}

glm::dvec2 FixationalMotion::displacement_deg(SessionTime time) const noexcept {
    const double t = to_seconds(time);
    glm::dvec2 sum(0.0);
    for (int axis = 0; axis < 2; ++axis) {
        for (const Wave& wave : waves_[static_cast<std::size_t>(axis)])
            sum[axis] += wave.amplitude_deg *
                         std::sin(2.0 * std::numbers::pi * wave.frequency_hz * t + wave.phase_rad);
    }
    return sum;
}

bool BlinkTrain::eye_closed_at(SessionTime time) const noexcept {
    if (!(rate_ > 0.0))
        return false;
    const double stretch_s = 60.0 / rate_;
    const double t = to_seconds(time);
    const double stretch = std::floor(t / stretch_s);
    RandomStream random(seed_, "blinks", static_cast<std::uint64_t>(static_cast<std::int64_t>(stretch)));
    const double length_s = std::min(random.uniform(shortest_blink_s, longest_blink_s), stretch_s);
    const double begin_s = random.uniform(0.0, stretch_s - length_s);
    const double within_s = t - stretch * stretch_s;
    return within_s >= begin_s && within_s < begin_s + length_s;
}

} // namespace overt
