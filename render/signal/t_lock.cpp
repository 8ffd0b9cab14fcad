#include "render/signal/t_lock.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

constexpr SignalPixel black{0, 0, 0, 255};

SignalPixel pixel(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue),
            255};
}

constexpr std::array<SignalPixel, 8> colour_table_key{{{36, 106, 133, 255},
                                                       {63, 136, 163, 255},
                                                       {8, 19, 138, 255},
                                                       {211, 25, 46, 255},
                                                       {3, 115, 164, 255},
                                                       {112, 68, 9, 255},
                                                       {56, 41, 49, 255},
                                                       {34, 159, 208, 255}}};
constexpr std::array<SignalPixel, 8> packet_key{{{69, 33, 56, 255},
                                                 {40, 230, 208, 255},
                                                 {19, 190, 102, 255},
                                                 {119, 84, 207, 255},
                                                 {52, 12, 192, 255},
                                                 {233, 108, 172, 255},
                                                 {41, 201, 80, 255},
                                                 {183, 124, 221, 255}}};

// Addresses of a packet's words.
constexpr int command_address = 6, mask_address = 7, first_output_address = 8;
constexpr int digital_output_group = 2;

} // namespace

namespace t_lock {

ColourTableRow row_of(const SignalColourTable& table) noexcept {
    ColourTableRow row;
    row.fill(black);
    std::copy(colour_table_key.begin(), colour_table_key.end(), row.begin());
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto [red, green, blue] = table[i];
        row[12 + 2 * i] = pixel(red >> 8, green >> 8, blue >> 8);
        row[13 + 2 * i] = pixel(red & 255, green & 255, blue & 255);
    }
    return row;
}

PacketRow row_of(const Packet& packet) noexcept {
    PacketRow row;
    row.fill(black);
    std::copy(packet_key.begin(), packet_key.end(), row.begin());
    constexpr int words = 2 + slots;
    row[8] = pixel(0, 0, words - 1);
    row[9] = pixel(command_address, packet.command, digital_output_group);
    row[11] = pixel(mask_address, packet.mask >> 8, packet.mask & 255);
    for (int slot = 0; slot < slots; ++slot) {
        const std::uint16_t word = packet.outputs[static_cast<std::size_t>(slot)];
        row[static_cast<std::size_t>(13 + 2 * slot)] =
            pixel(first_output_address + slot, word >> 8, word & 255);
    }
    return row;
}

Packet clock_reset() noexcept {
    Packet packet;
    packet.command = 12;
    return packet;
}

Packet pulse(std::uint16_t lines, double begin_ms, double duration_ms) noexcept {
    const auto slot_of = [](double ms) {
        return std::clamp(static_cast<int>(std::lround(10.0 * ms)), 0, slots);
    };
    Packet packet;
    packet.mask = 0xFFFF;
    std::fill(packet.outputs.begin() + slot_of(begin_ms),
              packet.outputs.begin() + slot_of(begin_ms + duration_ms), lines);
    return packet;
}

} // namespace t_lock

SignalPixel psync::outputs_pixel(int outputs) noexcept {
    return {static_cast<std::uint8_t>(outputs & 255), static_cast<std::uint8_t>((outputs >> 8) & 255),
            static_cast<std::uint8_t>((outputs >> 16) & 255), 255};
}

std::array<SignalPixel, 8> psync::pixels_of(std::uint8_t count) noexcept {
    return {pixel(255, 0, 0),   pixel(0, 255, 0),   pixel(0, 0, 255),     pixel(255, 255, 0),
            pixel(255, 0, 255), pixel(0, 255, 255), pixel(255, 255, 255), pixel(0, count, 0)};
}

} // namespace overt
