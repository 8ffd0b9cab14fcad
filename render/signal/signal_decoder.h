/// What a display makes of the bytes it receives. How each mode's bytes are read is written from the
/// description of its format alone (mode_coding.h): it shares neither code nor constants with what packs
/// them, so that neither can hide the other's errors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiment/protocol/output_mode.h"
#include "render/signal/received_messages.h"
#include "render/signal/screen_reader.h"

namespace overt {

/// What the display lights: one entry for each pixel, or for each pair of neighbours.
struct ReceivedLight {
    glm::ivec2 size{0};
    int highest = 65535;  ///< the level of full light
    bool is_grey = false; ///< all three channels are the same by the format
    std::vector<std::array<std::uint16_t, 3>> levels;

    const std::array<std::uint16_t, 3>& at(int x, int y) const {
        return levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)];
    }
};

/// The light of a screen in a mode. In Bits++ by the table in the screen's own top row: throws GraphicsError
/// if there is none. Overlay colours of Mono++ and transparent pixels are no light of ours and an error, too.
ReceivedLight receive_light(const SignalScreen& screen, OutputMode mode);

/// For decoders: light of `size` entries, of which levels_at(x, y) gives red, green and blue, 0 … `highest`.
template <class LevelsAt> ReceivedLight read_light(glm::ivec2 size, int highest, LevelsAt&& levels_at) {
    ReceivedLight light{size, highest, false, {}};
    light.levels.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const Rgb levels = levels_at(x, y);
            light.levels.push_back({static_cast<std::uint16_t>(levels.r),
                                    static_cast<std::uint16_t>(levels.g),
                                    static_cast<std::uint16_t>(levels.b)});
        }
    }
    return light;
}

} // namespace overt
