/// Sound on its way from the device's thread to the one that writes it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "experiment/base/spsc_ring.h"
#include "experiment/session_time.h"

namespace overt {

struct SoundBlock {
    static constexpr std::size_t room = 256;
    std::int64_t first_sample = 0;  ///< since the device was opened; a jump says what is lost
    SessionTime at;                 ///< when the first sample was taken, as far as the sound system knows
    bool is_after_overflow = false; ///< the sound system says that it lost something before
    std::uint32_t count = 0;
    std::array<float, room> samples{};
    std::span<const float> sound() const { return std::span(samples).first(count); }
};

/// Some five seconds at 48 kHz.
using SoundRing = SpscRing<SoundBlock>;
inline constexpr std::size_t sound_ring_blocks = 1024;

} // namespace overt
