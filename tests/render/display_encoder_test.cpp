#include "render/display_encoder.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/random.h"
#include "support/gl_contexts.h"

using namespace overt;

namespace {

/// What arrives at the display for a picture.
std::vector<unsigned char> sent(const GlContext& context, OutputMode mode, double gamma, glm::ivec2 size, const std::vector<glm::vec4>& light) {
    Texture2D linear(context, size, PixelFormat::rgba32f);
    linear.upload(std::as_bytes(std::span(light)));
    Texture2D wire(context, size, PixelFormat::rgba8);
    const Framebuffer target(context, {&wire}, false);
    DisplayEncoder(context, mode, gamma).encode(linear, target);
    std::vector<unsigned char> bytes(static_cast<std::size_t>(size.x * size.y) * 4);
    target.bind();
    read_pixels(context, 0, {0, 0}, size, PixelFormat::rgba8, std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

} // namespace

TEST_CASE("Color++ carries all 65,536 levels of each channel: high bytes left, low bytes right", "[gl]") {
    constexpr glm::ivec2 size{512, 256};
    for (const ContextKind kind : test::headless_kinds()) {
        const auto context = make_headless_context(kind);
        std::vector<glm::vec4> light;
        for (int level = 0; level < 65536; ++level) {
            // Other channels run through their levels in other orders.
            const glm::vec4 colour(glm::vec3(level, 65535 - level, (level * 20501) & 65535) / 65535.0f, 1.0f);
            light.insert(light.end(), 2, colour);
        }
        const auto bytes = sent(*context, OutputMode::color_plus_plus, 1.0, size, light);
        int wrong = 0;
        for (int level = 0; level < 65536; ++level) {
            const int expected[] = {level, 65535 - level, (level * 20501) & 65535};
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::size_t pair = static_cast<std::size_t>(level) * 8;
                wrong += bytes[pair + channel] * 256 + bytes[pair + 4 + channel] != expected[channel];
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("Color++ sends the mean of two neighbours in linear light, rounded to the nearest level", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    RandomStream random(11, "neighbours");
    std::vector<glm::vec4> light(2 * 4096);
    for (glm::vec4& pixel : light) pixel = glm::vec4(static_cast<float>(random.uniform()), static_cast<float>(random.uniform(-0.2, 1.3)), 0.25f, 1.0f);
    const double gamma = 2.2;
    const auto bytes = sent(*context, OutputMode::color_plus_plus, gamma, {128, 64}, light);
    int far_off = 0;
    for (std::size_t pair = 0; pair < 4096; ++pair) {
        for (int channel = 0; channel < 3; ++channel) {
            const double mean = 0.5 * (double{light[2 * pair][channel]} + double{light[2 * pair + 1][channel]});
            const double exact = 65535.0 * std::pow(std::clamp(mean, 0.0, 1.0), 1.0 / gamma);
            const std::size_t at = pair * 8 + static_cast<std::size_t>(channel);
            const int code = bytes[at] * 256 + bytes[at + 4];
            // Half a level of rounding, and what the shader's single precision adds to a power.
            far_off += std::abs(code - exact) > 0.5 + 0.15;
        }
    }
    CHECK(far_off == 0);
}

TEST_CASE("Mono++ carries 16 bits of grey in red and green and leaves the overlay empty", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    std::vector<glm::vec4> light;
    for (int level = 0; level < 65536; ++level) light.emplace_back(glm::vec3(static_cast<float>(level) / 65535.0f), 1.0f);
    const auto bytes = sent(*context, OutputMode::mono_plus_plus, 1.0, {256, 256}, light);
    int wrong = 0, overlay = 0;
    for (std::size_t level = 0; level < 65536; ++level) {
        wrong += std::abs(bytes[4 * level] * 256 + bytes[4 * level + 1] - static_cast<int>(level)) > 0;
        overlay += bytes[4 * level + 2] != 0;
    }
    CHECK(wrong == 0);
    CHECK(overlay == 0);
}

TEST_CASE("8 bits are rounded to the nearest level after the display's exponent", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    std::vector<glm::vec4> light;
    for (int i = 0; i < 4096; ++i) light.emplace_back(glm::vec3(static_cast<float>(i) / 4095.0f), 1.0f);
    const auto bytes = sent(*context, OutputMode::native_8bit, 2.2, {64, 64}, light);
    for (std::size_t i = 0; i < 4096; ++i) {
        const double exact = 255.0 * std::pow(static_cast<double>(i) / 4095.0, 1.0 / 2.2);
        CHECK(std::abs(bytes[4 * i] - exact) < 0.501);
    }
}
