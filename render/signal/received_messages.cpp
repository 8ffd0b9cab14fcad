#include "render/signal/received_messages.h"

#include <algorithm>
#include <string_view>

namespace overt {

namespace {

/// The eight colours that open a row of data, as a printed table has them: all reds, all greens, all blues.
struct Key {
    std::array<int, 8> reds, greens, blues;
    bool opens(const ScreenReader& reader, int row) const {
        for (int x = 0; x < 8; ++x) {
            const auto i = static_cast<std::size_t>(x);
            if (reader.colour(x, row) != Rgb{reds[i], greens[i], blues[i]})
                return false;
        }
        return true;
    }
};

// Cambridge Research Systems: the unlock codes of a lookup table and of digital output.
constexpr Key lookup_key{{0x24, 0x3F, 0x08, 0xD3, 0x03, 0x70, 0x38, 0x22},
                         {0x6A, 0x88, 0x13, 0x19, 0x73, 0x44, 0x29, 0x9F},
                         {0x85, 0xA3, 0x8A, 0x2E, 0xA4, 0x09, 0x31, 0xD0}};
constexpr Key output_key{{0x45, 0x28, 0x13, 0x77, 0x34, 0xE9, 0x29, 0xB7},
                         {0x21, 0xE6, 0xBE, 0x54, 0x0C, 0x6C, 0xC9, 0x7C},
                         {0x38, 0xD0, 0x66, 0xCF, 0xC0, 0xAC, 0x50, 0xDD}};

constexpr int lookup_row_length = 8 + 4 + 2 * 256;

ReceivedTable read_table(const ScreenReader& reader, int row) {
    ReceivedTable table;
    table.row = row;
    int x = 12;
    for (auto& colour : table.colours) {
        const Rgb upper = reader.colour(x, row), lower = reader.colour(x + 1, row);
        colour = {static_cast<std::uint16_t>(upper.r * 256 + lower.r),
                  static_cast<std::uint16_t>(upper.g * 256 + lower.g),
                  static_cast<std::uint16_t>(upper.b * 256 + lower.b)};
        x += 2;
    }
    return table;
}

/// Words until the row is black; what breaks the form is noted.
ReceivedPacket read_packet(const ScreenReader& reader, int row, std::vector<std::string>& faults) {
    const auto fault = [&](std::string_view what) { faults.push_back(fmt::format("row {}: {}", row, what)); };
    ReceivedPacket packet;
    packet.row = row;
    const Rgb length = reader.colour(8, row);
    packet.length_field = length.b;
    if (length.r != 0 || length.g != 0)
        fault("the pixel of the packet's length has red or green");
    packet.outputs.assign(248, 0);
    int words = 0, last_address = 0;
    for (int x = 9; words <= packet.length_field && x < reader.width(); x += 2, ++words) {
        const auto [address, high, low] = reader.colour(x, row);
        if (words < packet.length_field && x + 1 < reader.width() && reader.colour(x + 1, row) != Rgb{})
            fault(fmt::format("the pixel after word {} is not black", words));
        if (address <= last_address)
            fault(fmt::format("address {} after {}", address, last_address));
        last_address = address;
        if (address == 6) {
            packet.command = high;
            packet.group = low;
        } else if (address == 7) {
            packet.mask = high * 256 + low;
        } else if (address >= 8) {
            packet.outputs[static_cast<std::size_t>(address - 8)] = high * 256 + low;
        }
    }
    if (words != packet.length_field + 1)
        fault("the row ends before the packet does");
    return packet;
}

std::optional<int> read_psync(const ScreenReader& reader) {
    if (reader.width() < 18)
        return std::nullopt;
    constexpr std::string_view lit[] = {"r", "g", "b", "rg", "rb", "gb", "rgb"};
    const auto full = [](std::string_view channels, char channel) {
        return channels.find(channel) == std::string_view::npos ? 0 : 255;
    };
    int x = 10;
    for (const std::string_view channels : lit) {
        if (reader.colour(x++, 0) != Rgb{full(channels, 'r'), full(channels, 'g'), full(channels, 'b')})
            return std::nullopt;
    }
    const Rgb count = reader.colour(x, 0);
    return count.r == 0 && count.b == 0 ? std::optional(count.g) : std::nullopt;
}

} // namespace

std::optional<ReceivedTable> colour_table_in(const ScreenReader& reader, int row) {
    if (reader.width() < lookup_row_length || !lookup_key.opens(reader, row))
        return std::nullopt;
    return read_table(reader, row);
}

bool holds_message(const ScreenReader& reader, int row) {
    return (reader.width() >= 8 && (lookup_key.opens(reader, row) || output_key.opens(reader, row))) ||
           (row == 0 && read_psync(reader));
}

ReceivedMessages receive_messages(const SignalScreen& screen) {
    const ScreenReader reader(screen);
    ReceivedMessages messages;
    for (int row = 0; row < reader.height() && reader.width() >= 9; ++row) {
        if (lookup_key.opens(reader, row)) {
            if (reader.width() < lookup_row_length)
                messages.faults.push_back(fmt::format("row {}: the table of colours is cut off", row));
            else
                messages.tables.push_back(read_table(reader, row));
        } else if (output_key.opens(reader, row)) {
            messages.packets.push_back(read_packet(reader, row, messages.faults));
        }
    }
    messages.psync_count = read_psync(reader);
    if (messages.psync_count) {
        const Rgb corner = reader.colour(0, 0);
        messages.pixel_mode_outputs = corner.r + 256 * corner.g + 65536 * corner.b;
    }
    return messages;
}

std::vector<ReceivedPulse> pulses_of(const ReceivedPacket& packet) {
    std::vector<ReceivedPulse> pulses;
    const int slots = static_cast<int>(packet.outputs.size());
    for (int line = 0; line < 10; ++line) {
        const int bit = 1 << line;
        if (!(packet.mask & bit))
            continue;
        for (int slot = 0; slot < slots; ++slot) {
            if (!(packet.outputs[static_cast<std::size_t>(slot)] & bit))
                continue;
            int end = slot;
            while (end < slots && packet.outputs[static_cast<std::size_t>(end)] & bit)
                ++end;
            pulses.push_back({line, slot / 10.0, end / 10.0});
            slot = end;
        }
    }
    return pulses;
}

} // namespace overt
