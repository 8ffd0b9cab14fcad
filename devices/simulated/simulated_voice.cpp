#include "devices/simulated/simulated_voice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiment/base/random.h"

namespace overt {

namespace {

constexpr double pitch_hz = 120.0, syllables_hz = 4.0, attack_s = 0.005;
constexpr std::array<double, 12> harmonics{0.6, 0.8, 1.0, 1.0, 0.9, 0.7, 0.5, 0.35, 0.25, 0.2, 0.15, 0.1};

} // namespace

std::vector<float> simulated_sound(const SimulatedVoice& voice, double rate_hz, double duration_s,
                                   std::uint64_t seed) {
    const double noise = std::pow(10.0, voice.noise_dbfs / 20.0);
    double power = 0.0;
    for (const double harmonic : harmonics)
        power += 0.5 * harmonic * harmonic;
    const double level = std::pow(10.0, voice.voice_dbfs / 20.0) / std::sqrt(power);
    RandomStream random(seed, "room noise");
    std::vector<float> sound(static_cast<std::size_t>(std::max(0.0, duration_s * rate_hz)));
    for (std::size_t i = 0; i < sound.size(); ++i) {
        const double at_s = static_cast<double>(i) / rate_hz;
        double value = noise * random.normal();
        if (at_s >= voice.begin_s && at_s < voice.end_s) {
            const double since_s = at_s - voice.begin_s;
            const double swell = 0.65 + 0.35 * std::cos(2.0 * std::numbers::pi * syllables_hz * since_s);
            const double edge = std::min({1.0, since_s / attack_s, (voice.end_s - at_s) / attack_s});
            // Harmonics by the recurrence of cosines: one cosine a sample instead of twelve.
            const double step = 2.0 * std::numbers::pi * pitch_hz * since_s;
            const double twice = 2.0 * std::cos(step);
            double before = 1.0, now = std::cos(step), sum = 0.0;
            for (const double harmonic : harmonics) {
                sum += harmonic * now;
                before = std::exchange(now, twice * now - before);
            }
            value += level * swell * edge * sum;
        }
        sound[i] = static_cast<float>(std::clamp(voice.gain * value, -1.0, 1.0));
    }
    return sound;
}

} // namespace overt
