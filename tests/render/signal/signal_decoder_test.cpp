#include "render/signal/signal_decoder.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/signal/display_encoder.h"
#include "render/signal/signal_check.h"

using namespace overt;

namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<int> numbers) {
    Bytes bytes;
    for (const int number : numbers)
        bytes.push_back(static_cast<std::byte>(number));
    return bytes;
}

std::array<std::uint16_t, 3> colour(int r, int g, int b) {
    return {static_cast<std::uint16_t>(r), static_cast<std::uint16_t>(g), static_cast<std::uint16_t>(b)};
}

/// A screen of one colour, for rows to be put into.
struct Screen600 {
    static constexpr int width = 600, height = 4;
    Bytes bytes = Bytes(static_cast<std::size_t>(4 * width * height), std::byte{255});
    Screen600() { fill_row(0, 0), fill_row(1, 0), fill_row(2, 0), fill_row(3, 0); }
    void fill_row(int row, int grey) {
        for (int x = 0; x < width; ++x)
            put(x, row,
                {static_cast<std::uint8_t>(grey), static_cast<std::uint8_t>(grey),
                 static_cast<std::uint8_t>(grey), 255});
    }
    void put(int x, int y, SignalPixel pixel) {
        for (std::size_t i = 0; i < 4; ++i)
            bytes[static_cast<std::size_t>(4 * (y * width + x)) + i] = static_cast<std::byte>(pixel[i]);
    }
    template <class Row> void put_row(int y, const Row& row) {
        for (std::size_t x = 0; x < row.size(); ++x)
            put(static_cast<int>(x), y, row[x]);
    }
    SignalScreen screen() const { return {{width, height}, bytes}; }
};

/// The whole of a screen as the encoder has it.
Bytes encoded_screen(const DisplaySettings& display, const LinearImage& picture, glm::ivec2 origin) {
    const DisplayEncoder encoder(display);
    const glm::ivec2 screen{display.width_px, display.height_px};
    Bytes bytes(static_cast<std::size_t>(4 * screen.x * screen.y));
    encoder.encode_background(screen, bytes);
    const ScreenPatch patch = encoder.patch_of(origin, picture.size_px);
    Bytes page(static_cast<std::size_t>(4 * patch.size_px.x * patch.size_px.y));
    encoder.encode(picture, origin, page);
    for (int y = 0; y < patch.size_px.y; ++y) {
        std::copy_n(page.begin() + 4 * y * patch.size_px.x, 4 * patch.size_px.x,
                    bytes.begin() + 4 * ((patch.origin_px.y + y) * screen.x + patch.origin_px.x));
    }
    return bytes;
}

LinearImage random_picture(glm::ivec2 size, std::uint64_t seed) {
    RandomStream random(seed, "picture");
    LinearImage picture(size);
    for (glm::vec4& pixel : picture.pixels) {
        for (int channel = 0; channel < 4; ++channel)
            pixel[channel] = static_cast<float>(random.uniform(-0.1, 1.2));
        pixel.w = std::clamp(pixel.w, 0.0f, 1.0f);
    }
    return picture;
}

} // namespace

TEST_CASE("bytes are read as the formats describe them", "[unit]") {
    const Bytes two = bytes_of({19, 22, 237, 255, 53, 29, 202, 255});
    const auto pair = receive_light({{2, 1}, two}, OutputMode::color_plus_plus);
    REQUIRE(pair.levels.size() == 1);
    CHECK(pair.levels[0] == colour(4917, 5661, 60874));
    CHECK(receive_light({{2, 1}, two}, OutputMode::vpixx_c48).levels == pair.levels);
    const Bytes grey = bytes_of({1, 2, 0, 255});
    CHECK(receive_light({{1, 1}, grey}, OutputMode::mono_plus_plus).levels[0] == colour(258, 258, 258));
    CHECK(receive_light({{1, 1}, grey}, OutputMode::vpixx_m16).levels[0] == colour(258, 258, 258));
    CHECK(receive_light({{1, 1}, grey}, OutputMode::native_8bit).levels[0] == colour(1, 2, 0));
    // 1023, 1 and 512 in ten bits each, lowest first.
    const Bytes word = bytes_of({0xFF, 0x07, 0x00, 0xE0});
    CHECK(receive_light({{1, 1}, word}, OutputMode::native_10bit).levels[0] == colour(1023, 1, 512));
}

TEST_CASE("what no encoder of ours would send is refused", "[unit]") {
    const Bytes overlay = bytes_of({1, 2, 3, 255}), transparent = bytes_of({1, 2, 0, 254});
    CHECK_THROWS_AS(receive_light({{1, 1}, overlay}, OutputMode::mono_plus_plus), GraphicsError);
    CHECK_THROWS_AS(receive_light({{1, 1}, transparent}, OutputMode::mono_plus_plus), GraphicsError);
    CHECK_THROWS_AS(receive_light({{2, 1}, overlay}, OutputMode::native_8bit), GraphicsError);
    CHECK_THROWS_AS(receive_light({{1, 1}, overlay}, OutputMode::bits_plus_plus), GraphicsError);
}

TEST_CASE("messages come back as they were sent, in the rows they were sent in", "[unit]") {
    Screen600 screen;
    SignalColourTable table;
    for (std::size_t i = 0; i < 256; ++i)
        table[i] = colour(static_cast<int>(65535 - 3 * i), static_cast<int>(i * i), static_cast<int>(i));
    t_lock::Packet packet = t_lock::pulse(0b1000000101, 1.5, 3.2);
    screen.put_row(0, t_lock::row_of(table));
    screen.put_row(1, t_lock::row_of(t_lock::clock_reset()));
    screen.put_row(2, t_lock::row_of(packet));
    const ReceivedMessages messages = receive_messages(screen.screen());
    CHECK(messages.faults.empty());
    CHECK_FALSE(messages.psync_count);
    REQUIRE(messages.tables.size() == 1);
    CHECK(messages.tables[0].row == 0);
    CHECK(messages.tables[0].colours == table);
    REQUIRE(messages.packets.size() == 2);
    CHECK(messages.packets[0].row == 1);
    CHECK(messages.packets[0].command == 12);
    CHECK(messages.packets[0].mask == 0);
    const ReceivedPacket& outputs = messages.packets[1];
    CHECK(outputs.row == 2);
    CHECK(outputs.command == 0);
    CHECK(outputs.group == 2);
    CHECK(outputs.length_field == 249);
    CHECK(outputs.mask == 0xFFFF);
    CHECK(std::equal(outputs.outputs.begin(), outputs.outputs.end(), packet.outputs.begin()));
    const auto pulses = pulses_of(outputs);
    REQUIRE(pulses.size() == 3);
    const int lines[] = {0, 2, 9};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(pulses[i].line == lines[i]);
        CHECK(pulses[i].begin_ms == Approx(1.5));
        CHECK(pulses[i].end_ms == Approx(4.7));
    }
    // In Bits++ light is what the table says of an index.
    const auto light = receive_light(screen.screen(), OutputMode::bits_plus_plus);
    CHECK(light.at(17, 3) == table[0]);
}

TEST_CASE("a row shifted by a pixel is no message, and a packet with a broken form is a fault", "[unit]") {
    const auto row = t_lock::row_of(t_lock::pulse(1, 0.0, 1.0));
    Screen600 shifted;
    for (std::size_t x = 0; x < row.size(); ++x)
        shifted.put(static_cast<int>(x) + 1, 2, row[x]);
    CHECK(receive_messages(shifted.screen()).packets.empty());
    Screen600 broken;
    broken.put_row(2, row);
    broken.put(20, 2, {0, 1, 0, 255}); // between two words
    CHECK(receive_messages(broken.screen()).faults.size() == 1);
    Screen600 jumbled;
    jumbled.put_row(2, row);
    jumbled.put(15, 2, {8, 0, 1, 255}); // the address before it, again
    CHECK_FALSE(receive_messages(jumbled.screen()).faults.empty());
}

TEST_CASE("PSYNC is found on the top row only, with its count", "[unit]") {
    Screen600 screen;
    const auto pixels = psync::pixels_of(77);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        screen.put(psync::first_px + static_cast<int>(i), 0, pixels[i]);
    CHECK(receive_messages(screen.screen()).psync_count == 77);
    Screen600 lower;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        lower.put(psync::first_px + static_cast<int>(i), 1, pixels[i]);
    CHECK_FALSE(receive_messages(lower.screen()).psync_count);
}

TEST_CASE("random pictures of any size at any place arrive as predicted, in every packed mode", "[unit]") {
    struct Place {
        glm::ivec2 size, origin;
    };
    const Place places[] = {{{64, 20}, {8, 4}}, {{63, 17}, {9, 5}},  {{1, 1}, {101, 3}},
                            {{3, 9}, {0, 3}},   {{77, 11}, {53, 4}}, {{130, 25}, {0, 3}}};
    std::uint64_t seed = 1;
    for (const OutputModeRow& row : output_modes) {
        // The others need more than the encoder's bytes: a table of colours, or the last step on the card.
        if (row.shows == ShownLight::greys_by_table || row.framebuffer_bits > 8)
            continue;
        for (const PairFilter filter : {PairFilter::box, PairFilter::lanczos}) {
            for (const double gamma : {1.0, 2.2}) {
                for (const Place& place : places) {
                    DisplaySettings display;
                    display.output = row.mode;
                    display.pair_filter = filter;
                    display.gamma = gamma;
                    display.background = 0.3;
                    display.width_px = 130;
                    display.height_px = 32;
                    const LinearImage picture = random_picture(place.size, seed++);
                    const Bytes bytes = encoded_screen(display, picture, place.origin);
                    const SignalScreen screen{{display.width_px, display.height_px}, bytes};
                    const SignalFindings found = check_signal(screen, display, {&picture, place.origin});
                    CAPTURE(row.name, gamma, place.size.x, place.origin.x, found.first);
                    CHECK(found.different == 0);
                    CHECK(found.compared > 0);
                }
            }
        }
    }
}

TEST_CASE("a single changed byte is found, and where it is", "[unit]") {
    DisplaySettings display;
    display.width_px = 64;
    display.height_px = 32;
    const LinearImage picture = random_picture({31, 20}, 9);
    Bytes bytes = encoded_screen(display, picture, {5, 6});
    const std::size_t at = 4 * (10 * 64 + 21) + 1; // low byte of green of pair 10 in row 10
    bytes[at] ^= std::byte{1};
    const SignalFindings found = check_signal({{64, 32}, bytes}, display, {&picture, {5, 6}});
    CHECK(found.different == 1);
    CHECK(found.largest_difference == 1);
    CHECK(found.first.rfind("(10, 10) G: received", 0) == 0);
}
