#include "render/signal/display_encoder.h"

#include <cmath>
#include <numbers>

#include "experiment/base/error.h"
#include "experiment/stimulus/frame_memory.h"
#include "render/signal/mode_coding.h"

namespace overt {

namespace {

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
    const OutputModeRow& mode = row_of(display.output);
    // The index counts light itself: its table of colours undoes the gamma, in 16 bits.
    if (mode.shows == ShownLight::greys_by_table)
        return {LevelTable(mode.levels, 1.0)};
    if (!display.characterisation || mode.shows == ShownLight::colours)
        return channel_tables(display, mode.levels);
    // One signal drives all three channels; what counts is the luminance that they make together.
    const glm::dvec3 shares = luminance_shares(display);
    const auto& curves = display.characterisation->curves;
    const auto mixed = [&](double signal) {
        return shares.r * curves[0].light_of(signal) + shares.g * curves[1].light_of(signal) +
               shares.b * curves[2].light_of(signal);
    };
    const double full = mixed(1.0); // but for rounding, 1
    return {LevelTable(mode.levels, [&](double signal) { return mixed(signal) / full; })};
}

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return std::abs(x) < 1e-12 ? 1.0 : std::sin(angle) / angle;
}

/// Lanczos, three lobes, stretched to half the resolution: twelve pixels, of which the middle two are the
/// pair. C. E. Duchon, J. Appl. Meteorol. 18, 1979.
const std::array<double, 12>& lanczos_weights() {
    static const std::array<double, 12> all = [] {
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
    }();
    return all;
}

} // namespace

DisplayEncoder::DisplayEncoder(const DisplaySettings& display)
    : display_(display), coding_(&coding_of(display.output)), leaves_last_step_(keeps_16_bits(display)),
      reach_px_(pair_reach_px(display)), tables_{tables_of(display), luminance_shares(display),
                                                 reach_px_ > 0 ? &lanczos_weights() : nullptr} {}

ScreenPatch DisplayEncoder::patch_of(glm::ivec2 origin_px, glm::ivec2 size_px) const {
    const auto [begin, end] = changed_columns(display_, origin_px.x, size_px.x);
    return {{begin, origin_px.y}, {end - begin, size_px.y}};
}

void DisplayEncoder::encode_row(const Row& row, int width, std::byte* into) const {
    const glm::dvec3* light = row.data() + reach_px_;
    if (!leaves_last_step_) {
        coding_->encode({tables_, light}, width, into);
        return;
    }
    auto* codes = reinterpret_cast<std::uint16_t*>(into);
    const auto put = [&](int x, int channel, double position) {
        codes[4 * x + channel] =
            static_cast<std::uint16_t>(position * (65535.0 / tables_.at(channel).levels()) + 0.5);
    };
    if (display_.dither == Dithering::none) {
        RowLevels(tables_, light).for_colours(width, [&](int begin, int count, const ColourRun& run) {
            for (int i = 0; i < count; ++i) {
                for (int channel = 0; channel < 3; ++channel)
                    put(begin + i, channel,
                        run.levels[static_cast<std::size_t>(channel)][static_cast<std::size_t>(i)]);
            }
        });
    } else {
        for (int x = 0; x < width; ++x) {
            for (int channel = 0; channel < 3; ++channel)
                put(x, channel, tables_.at(channel).position_of(light[x][channel]));
        }
    }
    for (int x = 0; x < width; ++x)
        codes[4 * x + 3] = 65535;
}

void DisplayEncoder::encode(const LinearImage& picture, glm::ivec2 origin_px,
                            std::span<std::byte> into) const {
    const ScreenPatch patch = patch_of(origin_px, picture.size_px);
    OVERT_EXPECTS(into.size() == bytes_in(patch.size_px, format()));
    if (reach_px_ == 0 && !leaves_last_step_ && patch.origin_px == origin_px &&
        patch.size_px == picture.size_px) {
        // Rows follow one another in the picture as in what is made of it.
        coding_->encode({tables_, picture.pixels.data(), display_.background},
                        static_cast<int>(picture.pixels.size()), into.data());
        return;
    }
    const glm::dvec3 background(display_.background);
    Row row(static_cast<std::size_t>(patch.size_px.x + 2 * reach_px_), background);
    glm::dvec3* first = row.data() + reach_px_ + (origin_px.x - patch.origin_px.x);
    const std::size_t stride = bytes_in({patch.size_px.x, 1}, format());
    for (int y = 0; y < picture.size_px.y; ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            const glm::vec4& pixel = picture.at(x, y);
            first[x] = glm::dvec3(pixel) + (1.0 - double{pixel.w}) * background;
        }
        encode_row(row, patch.size_px.x, into.data() + static_cast<std::size_t>(y) * stride);
    }
}

void DisplayEncoder::encode_background(glm::ivec2 size_px, std::span<std::byte> into) const {
    OVERT_EXPECTS(into.size() == bytes_in(size_px, format()));
    const Row row(static_cast<std::size_t>(size_px.x + 2 * reach_px_), glm::dvec3(display_.background));
    const std::size_t stride = bytes_in({size_px.x, 1}, format());
    for (int y = 0; y < size_px.y; ++y)
        encode_row(row, size_px.x, into.data() + static_cast<std::size_t>(y) * stride);
}

SignalColourTable DisplayEncoder::colour_table() const {
    const std::vector<LevelTable> tables = channel_tables(display_, 65535);
    SignalColourTable colours{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            colours[i][channel] = static_cast<std::uint16_t>(
                tables[tables.size() == 1 ? 0 : channel].level_of(static_cast<double>(i) / 255.0));
    }
    return colours;
}

} // namespace overt
