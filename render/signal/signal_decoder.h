/// What a display makes of the bytes it receives. Written from the descriptions of the formats alone: it
/// shares neither code nor constants with what packs them, so that neither can hide the other's errors.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// A screen as it is scanned out: top row first, four bytes to a pixel, red first; in native_10bit
/// little-endian words with red in the lowest ten bits.
struct SignalScreen {
    glm::ivec2 size_px{0};
    std::span<const std::byte> bytes;
};

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

/// A T-Lock packet as it was read.
struct ReceivedPacket {
    int row = 0;
    int length_field = 0;
    int command = 0;
    int group = 0;
    int mask = 0;
    std::vector<int> outputs; ///< one word for each tenth of a millisecond
};

struct ReceivedTable {
    int row = 0;
    std::array<std::array<std::uint16_t, 3>, 256> colours{};
};

/// Messages in a screen, and what is wrong with them, in words.
struct ReceivedMessages {
    std::vector<ReceivedTable> tables;
    std::vector<ReceivedPacket> packets;
    std::optional<int> psync_count;        ///< of the code in the top row
    std::optional<int> pixel_mode_outputs; ///< of the top left pixel, where there is such a code
    std::vector<std::string> faults;
};

/// A time for which an output line is raised, from the beginning of the refresh in which the packet acts.
struct ReceivedPulse {
    int line = 0;
    double begin_ms = 0.0, end_ms = 0.0;
};

/// The light of a screen in a mode. In Bits++ by the table in the screen's own top row: throws GraphicsError
/// if there is none. Overlay colours of Mono++ and transparent pixels are no light of ours and an error, too.
ReceivedLight receive_light(const SignalScreen& screen, OutputMode mode);

ReceivedMessages receive_messages(const SignalScreen& screen);

/// The pulses that a packet makes on the lines of its mask.
std::vector<ReceivedPulse> pulses_of(const ReceivedPacket& packet);

} // namespace overt
