#include "render/signal/t_lock.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

// The unlock codes as vendor and Psychtoolbox print them: reds, greens, blues.
constexpr int table_key[3][8] = {{36, 63, 8, 211, 3, 112, 56, 34},
                                 {106, 136, 19, 25, 115, 68, 41, 159},
                                 {133, 163, 138, 46, 164, 9, 49, 208}};
constexpr int data_key[3][8] = {{69, 40, 19, 119, 52, 233, 41, 183},
                                {33, 230, 190, 84, 12, 108, 201, 124},
                                {56, 208, 102, 207, 192, 172, 80, 221}};

template <class Row> bool begins_with(const Row& row, const int (&key)[3][8]) {
    bool same = true;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        for (std::size_t x = 0; x < 8; ++x)
            same = same && row[x][channel] == key[channel][x];
    }
    return same;
}

const SignalPixel black{0, 0, 0, 255};

} // namespace

TEST_CASE("a table of colours is a row of 524 pixels: key, four black, high and low bytes in turn",
          "[unit]") {
    SignalColourTable table;
    for (std::size_t i = 0; i < 256; ++i)
        table[i].fill(static_cast<std::uint16_t>(257 * i));
    table[7] = {0x1234, 0xABCD, 0x8000};
    const auto row = t_lock::row_of(table);
    CHECK(row.size() == 524);
    CHECK(begins_with(row, table_key));
    for (std::size_t x = 8; x < 12; ++x)
        CHECK(row[x] == black);
    for (std::size_t i = 0; i < 256; ++i) {
        const auto byte = static_cast<std::uint8_t>(i);
        const SignalPixel same{byte, byte, byte, 255};
        if (i != 7) {
            CHECK(row[12 + 2 * i] == same);
            CHECK(row[13 + 2 * i] == same);
        }
    }
    CHECK(row[26] == SignalPixel{0x12, 0xAB, 0x80, 255});
    CHECK(row[27] == SignalPixel{0x34, 0xCD, 0x00, 255});
}

TEST_CASE("a packet is a row of 508 pixels: key, length, command, mask, and 248 words between black pixels",
          "[unit]") {
    t_lock::Packet packet;
    packet.command = 0;
    packet.mask = 0x0335;
    packet.outputs[0] = 0x0201;
    packet.outputs[247] = 0x00FF;
    const auto row = t_lock::row_of(packet);
    CHECK(row.size() == 508);
    CHECK(begins_with(row, data_key));
    CHECK(row[8] == SignalPixel{0, 0, 249, 255});
    CHECK(row[9] == SignalPixel{6, 0, 2, 255});
    CHECK(row[11] == SignalPixel{7, 0x03, 0x35, 255});
    CHECK(row[13] == SignalPixel{8, 0x02, 0x01, 255});
    for (std::size_t slot = 1; slot < 247; ++slot)
        CHECK(row[13 + 2 * slot] == SignalPixel{static_cast<std::uint8_t>(8 + slot), 0, 0, 255});
    CHECK(row[507] == SignalPixel{255, 0, 0xFF, 255});
    for (std::size_t x = 10; x < 508; x += 2)
        CHECK(row[x] == black);
}

TEST_CASE("the clock is reset by command 12, which touches no output", "[unit]") {
    const auto row = t_lock::row_of(t_lock::clock_reset());
    CHECK(row[9] == SignalPixel{6, 12, 2, 255});
    CHECK(row[11] == SignalPixel{7, 0, 0, 255});
    for (std::size_t slot = 0; slot < 248; ++slot)
        CHECK(row[13 + 2 * slot] == SignalPixel{static_cast<std::uint8_t>(8 + slot), 0, 0, 255});
}

TEST_CASE("a pulse of 4 ms from 2 ms on line 1 is the words 20 to 59", "[unit]") {
    const t_lock::Packet packet = t_lock::pulse(2, 2.0, 4.0);
    CHECK(packet.mask == 0xFFFF);
    for (std::size_t slot = 0; slot < 248; ++slot)
        CHECK(packet.outputs[slot] == (slot >= 20 && slot < 60 ? 2 : 0));
    // What goes past the last slot ends there.
    CHECK(t_lock::pulse(1, 24.0, 5.0).outputs[247] == 1);
}

TEST_CASE("PSYNC is seven fixed colours and a count in green", "[unit]") {
    const auto pixels = psync::pixels_of(201);
    const std::array<SignalPixel, 8> expected{{{255, 0, 0, 255},
                                               {0, 255, 0, 255},
                                               {0, 0, 255, 255},
                                               {255, 255, 0, 255},
                                               {255, 0, 255, 255},
                                               {0, 255, 255, 255},
                                               {255, 255, 255, 255},
                                               {0, 201, 0, 255}}};
    CHECK(pixels == expected);
}
