/// What a display reads in the rows that carry messages. Written from the descriptions of the formats alone:
/// it shares neither code nor constants with t_lock.h, which packs them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/signal/screen_reader.h"

namespace overt {

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

ReceivedMessages receive_messages(const SignalScreen& screen);

/// The pulses that a packet makes on the lines of its mask.
std::vector<ReceivedPulse> pulses_of(const ReceivedPacket& packet);

/// The table of colours in a row, if one is there.
std::optional<ReceivedTable> colour_table_in(const ScreenReader& reader, int row);

/// Whether a row is a message and no light.
bool holds_message(const ScreenReader& reader, int row);

} // namespace overt
