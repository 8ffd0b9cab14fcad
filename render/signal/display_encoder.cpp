#include "render/signal/display_encoder.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include "experiment/base/error.h"
#include "experiment/stimulus/frame_memory.h"
#include "render/image/processor_clones.h"

namespace overt {

namespace {

int levels_of(const DisplaySettings& display) {
    switch (display.output) {
    case OutputMode::native_8bit:
    case OutputMode::bits_plus_plus: // the index
        return 255;
    case OutputMode::native_10bit:
        return 1023;
    default:
        return 65535;
    }
}

bool is_grey(OutputMode mode) {
    return mode == OutputMode::mono_plus_plus || mode == OutputMode::vpixx_m16 ||
           mode == OutputMode::bits_plus_plus;
}

/// How much of a grey's luminance each channel has: as measured, or as in Rec. 709 (ITU-R BT.709-6).
glm::dvec3 luminance_shares(const DisplaySettings& display) {
    return display.characterisation ? display.characterisation->luminance_shares()
                                    : glm::dvec3(0.2126, 0.7152, 0.0722);
}

/// One table for each channel of a characterised display.
std::vector<LevelTable> channel_tables(const DisplaySettings& display, int levels) {
    if (!display.characterisation)
        return {LevelTable(levels, display.gamma)};
    std::vector<LevelTable> tables;
    for (const ChannelCurve& curve : display.characterisation->curves)
        tables.emplace_back(levels, [&curve](double signal) { return curve.light_of(signal); });
    return tables;
}

std::vector<LevelTable> tables_of(const DisplaySettings& display) {
    const int levels = levels_of(display);
    // The index of Bits++ counts light itself: its table of colours undoes the gamma, in 16 bits.
    if (display.output == OutputMode::bits_plus_plus)
        return {LevelTable(levels, 1.0)};
    if (!display.characterisation || !is_grey(display.output))
        return channel_tables(display, levels);
    // One signal drives all three channels; what counts is the luminance that they make together.
    const glm::dvec3 shares = luminance_shares(display);
    const auto& curves = display.characterisation->curves;
    const auto mixed = [&](double signal) {
        return shares.r * curves[0].light_of(signal) + shares.g * curves[1].light_of(signal) +
               shares.b * curves[2].light_of(signal);
    };
    const double full = mixed(1.0); // but for rounding, 1
    return {LevelTable(levels, [&](double signal) { return mixed(signal) / full; })};
}

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return std::abs(x) < 1e-12 ? 1.0 : std::sin(angle) / angle;
}

/// Lanczos, three lobes, stretched to half the resolution: twelve pixels, of which the middle two are the
/// pair. C. E. Duchon, J. Appl. Meteorol. 18, 1979.
std::array<double, 12> lanczos_weights() {
    std::array<double, 12> weights{};
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double distance = (static_cast<double>(i) - 5.5) / 2.0;
        weights[i] = sinc(distance) * sinc(distance / 3.0);
        sum += weights[i];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

void put_bytes(std::byte* pixel, int red, int green, int blue) {
    pixel[0] = static_cast<std::byte>(red);
    pixel[1] = static_cast<std::byte>(green);
    pixel[2] = static_cast<std::byte>(blue);
    pixel[3] = std::byte{255};
}

// Four numbers that are reckoned with together; a compiler has them in registers of whatever width there is.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));
using FourInts = int __attribute__((vector_size(16)));

/// What encode_row() makes of whole pairs joined by a box filter, for a display that linearises itself, with
/// all channels of a pair at once: half of the time to load a stimulus went into this. Clones for processors
/// that have wider registers give the same bytes: there is nothing in it that they may round differently.
OVERT_PROCESSOR_CLONES("avx2")
void encode_linear_pairs(const glm::vec4* pixels, int pairs, double background, double levels, double half,
                         std::byte* into) {
    const Four all_levels = Four{} + levels, all_halves = Four{} + half, zero{}, one = Four{} + 1.0;
    for (int pair = 0; pair < pairs; ++pair, pixels += 2, into += 8) {
        FourFloats left, right;
        std::memcpy(&left, &pixels[0], sizeof left);
        std::memcpy(&right, &pixels[1], sizeof right);
        const Four behind_left = Four{} + (1.0 - double{left[3]}) * background,
                   behind_right = Four{} + (1.0 - double{right[3]}) * background;
        const Four mean = 0.5 * ((__builtin_convertvector(left, Four) + behind_left) +
                                 (__builtin_convertvector(right, Four) + behind_right));
        const Four above = mean > zero ? mean : zero, inside = above < one ? above : one;
        const FourInts code = __builtin_convertvector(inside * all_levels + all_halves, FourInts);
        put_bytes(into, code[0] >> 8, code[1] >> 8, code[2] >> 8);
        put_bytes(into + 4, code[0] & 255, code[1] & 255, code[2] & 255);
    }
}

std::size_t pixels_in(glm::ivec2 size_px) {
    return static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
}

} // namespace

DisplayEncoder::DisplayEncoder(const DisplaySettings& display)
    : display_(display), leaves_last_step_(keeps_16_bits(display)), reach_px_(pair_reach_px(display)),
      luminance_(luminance_shares(display)), tables_(tables_of(display)), lanczos_(lanczos_weights()) {}

ScreenPatch DisplayEncoder::patch_of(glm::ivec2 origin_px, glm::ivec2 size_px) const {
    const auto [begin, end] = changed_columns(display_, origin_px.x, size_px.x);
    return {{begin, origin_px.y}, {end - begin, size_px.y}};
}

glm::dvec3 DisplayEncoder::pair_at(const glm::dvec3* left) const {
    if (reach_px_ == 0)
        return 0.5 * (left[0] + left[1]);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 12; ++i)
        sum += lanczos_[static_cast<std::size_t>(i)] * left[i - 5];
    return sum;
}

int DisplayEncoder::grey_level(const glm::dvec3& light) const {
    return table_of(0).level_of(luminance_.r * light.r + luminance_.g * light.g + luminance_.b * light.b);
}

void DisplayEncoder::encode_row(const Row& row, int width, std::byte* into) const {
    const glm::dvec3* light = row.data() + reach_px_;
    const LevelTable &reds = table_of(0), &greens = table_of(1), &blues = table_of(2);
    if (leaves_last_step_) {
        auto* codes = reinterpret_cast<std::uint16_t*>(into);
        for (int x = 0; x < width; ++x, codes += 4) {
            for (int channel = 0; channel < 3; ++channel) {
                const LevelTable& table = table_of(channel);
                const double position = display_.dither == Dithering::none
                                            ? table.level_of(light[x][channel])
                                            : table.position_of(light[x][channel]);
                codes[channel] = static_cast<std::uint16_t>(position * (65535.0 / table.levels()) + 0.5);
            }
            codes[3] = 65535;
        }
        return;
    }
    switch (display_.output) {
    case OutputMode::native_8bit:
    case OutputMode::native_10bit:
        for (int x = 0; x < width; ++x, into += 4)
            put_bytes(into, reds.level_of(light[x].r), greens.level_of(light[x].g),
                      blues.level_of(light[x].b));
        return;
    case OutputMode::bits_plus_plus:
        for (int x = 0; x < width; ++x, into += 4) {
            const int index = grey_level(light[x]);
            put_bytes(into, index, index, index);
        }
        return;
    case OutputMode::mono_plus_plus:
    case OutputMode::vpixx_m16:
        for (int x = 0; x < width; ++x, into += 4) {
            const int code = grey_level(light[x]);
            put_bytes(into, code >> 8, code & 255, 0); // blue 0: no overlay
        }
        return;
    case OutputMode::color_plus_plus:
    case OutputMode::vpixx_c48:
        for (int x = 0; x < width; x += 2, into += 8) {
            const glm::dvec3 colour = pair_at(light + x);
            const int red = reds.level_of(colour.r), green = greens.level_of(colour.g),
                      blue = blues.level_of(colour.b);
            put_bytes(into, red >> 8, green >> 8, blue >> 8);
            put_bytes(into + 4, red & 255, green & 255, blue & 255);
        }
        return;
    }
}

void DisplayEncoder::encode(const LinearImage& picture, glm::ivec2 origin_px,
                            std::span<std::byte> into) const {
    const ScreenPatch patch = patch_of(origin_px, picture.size_px);
    OVERT_EXPECTS(into.size() == pixels_in(patch.size_px) * bytes_per_pixel(format()));
    if (joins_pixels_in_pairs(display_.output) && reach_px_ == 0 && tables_.size() == 1 &&
        tables_[0].is_linear() && patch.origin_px == origin_px && patch.size_px == picture.size_px) {
        // Rows follow one another in the picture as in what is made of it.
        encode_linear_pairs(picture.pixels.data(), static_cast<int>(picture.pixels.size() / 2),
                            display_.background, tables_[0].levels(), LevelTable::half, into.data());
        return;
    }
    const glm::dvec3 background(display_.background);
    Row row(static_cast<std::size_t>(patch.size_px.x + 2 * reach_px_), background);
    glm::dvec3* first = row.data() + reach_px_ + (origin_px.x - patch.origin_px.x);
    const std::size_t stride = static_cast<std::size_t>(patch.size_px.x) * bytes_per_pixel(format());
    for (int y = 0; y < picture.size_px.y; ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            const glm::vec4& pixel = picture.at(x, y);
            first[x] = glm::dvec3(pixel) + (1.0 - double{pixel.w}) * background;
        }
        encode_row(row, patch.size_px.x, into.data() + static_cast<std::size_t>(y) * stride);
    }
}

void DisplayEncoder::encode_background(glm::ivec2 size_px, std::span<std::byte> into) const {
    OVERT_EXPECTS(into.size() == pixels_in(size_px) * bytes_per_pixel(format()));
    const Row row(static_cast<std::size_t>(size_px.x + 2 * reach_px_), glm::dvec3(display_.background));
    const std::size_t stride = static_cast<std::size_t>(size_px.x) * bytes_per_pixel(format());
    for (int y = 0; y < size_px.y; ++y)
        encode_row(row, size_px.x, into.data() + static_cast<std::size_t>(y) * stride);
}

ColourTable DisplayEncoder::colour_table() const {
    const std::vector<LevelTable> tables = channel_tables(display_, 65535);
    ColourTable colours{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            colours[i][channel] = static_cast<std::uint16_t>(
                tables[tables.size() == 1 ? 0 : channel].level_of(static_cast<double>(i) / 255.0));
    }
    return colours;
}

} // namespace overt
