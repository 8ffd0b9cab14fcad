/// A voice whose beginning is known.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

struct SimulatedVoice {
    double noise_dbfs = -60.0;         ///< root mean square of the room
    double voice_dbfs = -22.0;         ///< and of the voice
    double begin_s = 0.0, end_s = 0.0; ///< since the recording's first sample; no voice if they are equal
    double gain = 1.0;                 ///< of all of it, before it is clipped at full scale
};

/// Harmonics of 120 Hz that swell four times a second, in white noise. The voice is there within 5 ms.
std::vector<float> simulated_sound(const SimulatedVoice& voice, double rate_hz, double duration_s,
                                   std::uint64_t seed);

} // namespace overt
