/// T-Lock: rows of the picture that a Display++ or Bits# reads as messages, by a key of eight colours at
/// their left end. One kind of key announces a table of colours, another a packet of words. The box acts on a
/// row at each refresh that shows it, with effect from the next refresh on.
///
/// Keys, rows and layouts as Cambridge Research Systems' own psychopy-crs (bits.py) and Psychtoolbox-3
/// (BitsPlusEncodeClutRow.m, BitsPlusDIO2Matrix.m, bitsEncodeDIO.m) send them.
#pragma once

#include <array>
#include <cstdint>

namespace overt {

/// Red, green, blue, alpha as they are sent.
using SignalPixel = std::array<std::uint8_t, 4>;

/// The 16-bit colours that the 256 indices of Bits++ stand for.
using SignalColourTable = std::array<std::array<std::uint16_t, 3>, 256>;

namespace t_lock {

// Rows of the screen, from the top.
inline constexpr int colour_table_row = 0;
inline constexpr int clock_reset_row = 1;
inline constexpr int outputs_row = 2;

using ColourTableRow = std::array<SignalPixel, 524>;
using PacketRow = std::array<SignalPixel, 508>;

/// Slots of 0.1 ms, from the beginning of a refresh.
inline constexpr int slots = 248;

/// One packet, in the fixed form that Psychtoolbox sends: a command, a mask of outputs, and 248 words of
/// outputs.
struct Packet {
    std::uint8_t command = 0;                   ///< 0: set the digital outputs; 12: reset the box's clock
    std::uint16_t mask = 0;                     ///< outputs that the packet changes
    std::array<std::uint16_t, slots> outputs{}; ///< one word for each slot; bits 0 … 9 are lines 0 … 9
};

/// Key, four black pixels, and each entry as a pixel of high and one of low bytes.
ColourTableRow row_of(const SignalColourTable& table) noexcept;

/// Key, the number of words less one in blue, then address, high and low byte in every second pixel.
PacketRow row_of(const Packet& packet) noexcept;

/// Sets the box's clock to 0. Its mask is empty: the outputs stay as they are.
Packet clock_reset() noexcept;

/// Raises `lines` (a bit each, 0 … 1023) for a time within the refresh and lowers all others. The times are
/// rounded to slots of 0.1 ms and end with the last slot, 24.8 ms.
Packet pulse(std::uint16_t lines, double begin_ms, double duration_ms) noexcept;

} // namespace t_lock

/// PSYNC: eight pixels from the eleventh of a black top row, by which VPixx devices know a refresh: seven
/// fixed colours and a count. As Psychtoolbox-3 (PsychDataPixx.m) sends them.
namespace psync {

inline constexpr int row = 0;
inline constexpr int first_px = 10;

/// The top left pixel, whose colour a VPixx device in Pixel Mode puts on its 24 digital outputs for the
/// refresh: red on 0 … 7, green on 8 … 15, blue on 16 … 23.
SignalPixel outputs_pixel(int outputs) noexcept;

/// The eight pixels; `count` is that of the refresh, modulo 256.
std::array<SignalPixel, 8> pixels_of(std::uint8_t count) noexcept;

} // namespace psync

} // namespace overt
