#include "render/signal/display_encoder.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/stimulus/frame_memory.h"

using namespace overt;

namespace {

DisplaySettings display_for(OutputMode mode, glm::ivec2 screen, double gamma = 1.0) {
    DisplaySettings display;
    display.output = mode;
    display.width_px = screen.x;
    display.height_px = screen.y;
    display.gamma = gamma;
    return display;
}

std::vector<int> sent(const DisplaySettings& display, const LinearImage& picture,
                      glm::ivec2 origin = {0, 0}) {
    const DisplayEncoder encoder(display);
    const glm::ivec2 size = encoder.patch_of(origin, picture.size_px).size_px;
    std::vector<std::byte> bytes(bytes_in(size, encoder.format()));
    encoder.encode(picture, origin, bytes);
    std::vector<int> numbers;
    for (const std::byte byte : bytes)
        numbers.push_back(std::to_integer<int>(byte));
    return numbers;
}

LinearImage plain(glm::ivec2 size, glm::vec3 light) {
    LinearImage image(size);
    std::fill(image.pixels.begin(), image.pixels.end(), glm::vec4(light, 1.0f));
    return image;
}

glm::vec3 of_codes(int r, int g, int b) {
    return {static_cast<float>(r / 65535.0), static_cast<float>(g / 65535.0),
            static_cast<float>(b / 65535.0)};
}

} // namespace

TEST_CASE("the colour 4917, 5661, 60874 is sent in Color++ as 19, 22, 237 and 53, 29, 202", "[unit]") {
    const auto bytes =
        sent(display_for(OutputMode::color_plus_plus, {2, 1}), plain({2, 1}, of_codes(4917, 5661, 60874)));
    CHECK(bytes == std::vector<int>{19, 22, 237, 255, 53, 29, 202, 255});
}

TEST_CASE("codes are split into high and low bytes, by the same rule in both 16-bit modes", "[unit]") {
    struct Vector {
        double light;
        int high, low;
    };
    // Between two codes, too: 255.6 is nearer to 256, and 511.7 to 512.
    const Vector vectors[] = {
        {0.0, 0, 0},           {1 / 65535.0, 0, 1},     {255 / 65535.0, 0, 255}, {256 / 65535.0, 1, 0},
        {257 / 65535.0, 1, 1}, {0.5, 128, 0},           {1.0, 255, 255},         {-5.0, 0, 0},
        {1.07, 255, 255},      {255.6 / 65535.0, 1, 0}, {511.7 / 65535.0, 2, 0}};
    for (const Vector& vector : vectors) {
        CAPTURE(vector.light);
        const LinearImage picture = plain({2, 1}, glm::vec3(static_cast<float>(vector.light)));
        for (const OutputMode mode : {OutputMode::color_plus_plus, OutputMode::vpixx_c48}) {
            const auto bytes = sent(display_for(mode, {2, 1}), picture);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                CHECK(bytes[channel] == vector.high);
                CHECK(bytes[4 + channel] == vector.low);
            }
        }
        for (const OutputMode mode : {OutputMode::mono_plus_plus, OutputMode::vpixx_m16}) {
            const auto bytes = sent(display_for(mode, {2, 1}), picture);
            CHECK(bytes ==
                  std::vector<int>{vector.high, vector.low, 0, 255, vector.high, vector.low, 0, 255});
        }
    }
}

TEST_CASE("a ramp of 8-bit numbers fills the low bytes", "[unit]") {
    LinearImage ramp({10, 1});
    for (int x = 0; x < 10; ++x)
        ramp.at(x, 0) = glm::vec4(of_codes(2 * (x / 2) + 1, 0, 0), 1.0f);
    const auto bytes = sent(display_for(OutputMode::color_plus_plus, {10, 1}), ramp);
    for (int x = 0; x < 10; ++x)
        CHECK(bytes[static_cast<std::size_t>(4 * x)] == (x % 2 == 0 ? 0 : x));
}

TEST_CASE("neighbours one count apart are not mixed into a third value", "[unit]") {
    LinearImage two({2, 1});
    two.at(0, 0) = glm::vec4(of_codes(0x0100, 0, 0), 1.0f);
    two.at(1, 0) = glm::vec4(of_codes(0x00FF, 0, 0), 1.0f);
    const auto bytes = sent(display_for(OutputMode::color_plus_plus, {2, 1}), two);
    const int code = bytes[0] * 256 + bytes[4];
    CHECK((code == 0xFF || code == 0x100));
}

TEST_CASE("pairs of pixels are packed alike whether they fill the patch or are filtered in rows", "[unit]") {
    // The same picture at an odd column goes through the rows; a column of background before and behind it.
    RandomStream random(4, "pairs");
    for (const double gamma : {1.0, 2.2}) {
        DisplaySettings display = display_for(OutputMode::color_plus_plus, {64, 8});
        display.gamma = gamma;
        display.background = 0.2;
        LinearImage inner({30, 8}), outer({32, 8});
        std::fill(outer.pixels.begin(), outer.pixels.end(), glm::vec4(0.0f));
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 30; ++x) {
                const float alpha = x % 5 == 0 ? 0.0f : static_cast<float>(random.uniform());
                inner.at(x, y) = glm::vec4(
                    alpha * glm::vec3(1.3f, 0.5f, 0.01f) * static_cast<float>(random.uniform()), alpha);
                outer.at(x + 1, y) = inner.at(x, y);
            }
        }
        const DisplayEncoder encoder(display);
        std::vector<std::byte> by_rows(32 * 8 * 4), at_once(32 * 8 * 4);
        encoder.encode(inner, {17, 0}, by_rows);
        encoder.encode(outer, {16, 0}, at_once);
        CAPTURE(gamma);
        CHECK(by_rows == at_once);
    }
}

TEST_CASE("a pair at the edge of a picture mixes it with the background in equal parts", "[unit]") {
    DisplaySettings display = display_for(OutputMode::color_plus_plus, {12, 1});
    display.background = 0.25;
    const DisplayEncoder encoder(display);
    const LinearImage picture = plain({4, 1}, glm::vec3(0.75f));
    // From column 3 to 6: half of the pairs 1 and 3, all of pair 2.
    const ScreenPatch patch = encoder.patch_of({3, 0}, picture.size_px);
    CHECK(patch.origin_px == glm::ivec2(2, 0));
    CHECK(patch.size_px == glm::ivec2(6, 1));
    const auto bytes = sent(display, picture, {3, 0});
    const auto code = [&](std::size_t pair) { return bytes[8 * pair] * 256 + bytes[8 * pair + 4]; };
    CHECK(code(0) == 32768);
    CHECK(code(1) == 49151);
    CHECK(code(2) == 32768);
}

TEST_CASE("a transparent pixel lets the background through by its alpha", "[unit]") {
    DisplaySettings display = display_for(OutputMode::mono_plus_plus, {600, 1});
    display.background = 0.5;
    LinearImage picture({1, 1});
    picture.at(0, 0) = {0.25f, 0.25f, 0.25f, 0.5f};
    const auto bytes = sent(display, picture);
    CHECK(bytes[0] * 256 + bytes[1] == 32768);
}

TEST_CASE("the Lanczos filter keeps plain light, passes slow waves and stops what pairs cannot show",
          "[unit]") {
    constexpr int width = 256;
    DisplaySettings display = display_for(OutputMode::color_plus_plus, {width, 1});
    display.pair_filter = PairFilter::lanczos;
    display.background = 0.5;
    const auto amplitude_of = [&](double cycles_per_px) {
        LinearImage wave({width, 1});
        for (int x = 0; x < width; ++x)
            wave.at(x, 0) =
                glm::vec4(glm::vec3(static_cast<float>(
                              0.5 + 0.4 * std::sin(6.283185307 * cycles_per_px * (x + 0.5) + 0.3))),
                          1.0f);
        const auto bytes = sent(display, wave);
        int low = 65535, high = 0;
        for (std::size_t pair = 16; pair < width / 2 - 16; ++pair) {
            const int code = bytes[8 * pair] * 256 + bytes[8 * pair + 4];
            low = std::min(low, code);
            high = std::max(high, code);
        }
        return (high - low) / 2.0 / 65535.0;
    };
    CHECK(amplitude_of(0.0) == 0.0);
    CHECK(amplitude_of(0.0517) == Approx(0.4).epsilon(0.02));
    CHECK(amplitude_of(0.45) < 0.01);
    // The mean of two lets waves through that pairs cannot show, as others of another width.
    display.pair_filter = PairFilter::box;
    CHECK(amplitude_of(0.45) > 0.04);
}

TEST_CASE("neither filter moves a picture", "[unit]") {
    // The centroid of a smooth blob, in columns of the screen, before and after.
    constexpr int width = 128;
    for (const PairFilter filter : {PairFilter::box, PairFilter::lanczos}) {
        DisplaySettings display = display_for(OutputMode::color_plus_plus, {width, 1});
        display.pair_filter = filter;
        for (const double centre : {63.0, 63.5, 64.2}) {
            LinearImage blob({width, 1});
            for (int x = 0; x < width; ++x) {
                const double d = (x + 0.5 - centre) / 6.0;
                blob.at(x, 0) = glm::vec4(glm::vec3(static_cast<float>(0.8 * std::exp(-d * d))), 1.0f);
            }
            const auto bytes = sent(display, blob);
            double sum = 0.0, moment = 0.0;
            for (std::size_t pair = 0; pair < width / 2; ++pair) {
                const double code = bytes[8 * pair] * 256 + bytes[8 * pair + 4];
                sum += code;
                moment += code * (2.0 * static_cast<double>(pair) + 1.0);
            }
            CAPTURE(centre);
            CHECK(moment / sum == Approx(centre).margin(0.01));
        }
    }
}

TEST_CASE("Bits++ sends the index of a grey in all channels, and a table that undoes the gamma in 16 bits",
          "[unit]") {
    const DisplaySettings display = display_for(OutputMode::bits_plus_plus, {600, 1}, 2.2);
    LinearImage ramp({256, 1});
    for (int i = 0; i < 256; ++i)
        ramp.at(i, 0) = glm::vec4(glm::vec3(static_cast<float>(i / 255.0)), 1.0f);
    const auto bytes = sent(display, ramp);
    const SignalColourTable table = DisplayEncoder(display).colour_table();
    for (std::size_t i = 0; i < 256; ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            CHECK(bytes[4 * i + channel] == static_cast<int>(i));
            CHECK(table[i][channel] ==
                  static_cast<int>(65535.0 * std::pow(static_cast<double>(i) / 255.0, 1.0 / 2.2) + 0.5));
        }
    }
}

TEST_CASE("8 bits are rounded to the nearest level after the display's exponent", "[unit]") {
    LinearImage ramp({4096, 1});
    for (int i = 0; i < 4096; ++i)
        ramp.at(i, 0) = glm::vec4(glm::vec3(static_cast<float>(i) / 4095.0f), 1.0f);
    const auto bytes = sent(display_for(OutputMode::native_8bit, {4096, 1}, 2.2), ramp);
    for (std::size_t i = 0; i < 4096; ++i) {
        const double exact = 255.0 * std::pow(static_cast<double>(i) / 4095.0, 1.0 / 2.2);
        CHECK(std::abs(bytes[4 * i] - exact) < 0.5001);
    }
}

TEST_CASE("whole pairs are sent as pairs that begin in the middle of a picture are", "[unit]") {
    const glm::ivec2 size{64, 9};
    RandomStream random(7, "pairs");
    LinearImage picture(size);
    for (glm::vec4& pixel : picture.pixels) {
        for (int channel = 0; channel < 4; ++channel)
            pixel[channel] =
                static_cast<float>(random.uniform(channel == 3 ? 0.0 : -0.1, channel == 3 ? 1.0 : 1.1));
    }
    // The same with a transparent column before it, which takes the other way through the encoder.
    LinearImage wider({size.x + 1, size.y});
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            wider.at(x + 1, y) = picture.at(x, y);
    }
    DisplaySettings display = display_for(OutputMode::color_plus_plus, {size.x + 2, size.y});
    display.background = 0.3;
    const auto pairs = sent(display, picture, {2, 0}), all = sent(display, wider, {1, 0});
    const auto columns = static_cast<std::size_t>(4 * size.x);
    for (std::size_t row = 0; row < static_cast<std::size_t>(size.y); ++row) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row * (columns + 8) + 8);
        CHECK(std::equal(begin, begin + static_cast<std::ptrdiff_t>(columns),
                         pairs.begin() + static_cast<std::ptrdiff_t>(row * columns)));
    }
}

TEST_CASE("what a page takes is reckoned before any is drawn as the encoder has it", "[unit]") {
    for (const OutputModeRow& row : output_modes) {
        for (const Dithering dither : {Dithering::none, Dithering::blue_noise}) {
            for (const int left : {0, 1, 37, 1920 - 201, 1920 - 200}) {
                Protocol protocol;
                protocol.display.output = row.mode;
                protocol.display.dither = dither;
                protocol.display.pair_filter = left % 2 == 0 ? PairFilter::lanczos : PairFilter::box;
                protocol.views.front().width_px = 200;
                protocol.views.front().height_px = 30;
                protocol.views.front().left_px = left;
                const DisplayEncoder encoder(protocol.display);
                const ScreenGeometry geometry = screen_geometry_of(protocol);
                const glm::ivec2 size = encoder.patch_of(geometry.image_origin_px, geometry.image_px).size_px;
                CHECK(page_bytes(protocol) == static_cast<double>(bytes_in(size, encoder.format())));
            }
        }
    }
}
