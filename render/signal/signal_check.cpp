#include "render/signal/signal_check.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// One row's part of the findings.
SignalFindings check_row(const ReceivedLight& received, const SignalPrediction& prediction, bool dithered,
                         int y) {
    SignalFindings found;
    const std::size_t channels = received.is_grey ? 1 : 3;
    // Neighbours are often alike, above all in the background: what was reckoned last is kept.
    std::array<double, 3> last_light{-1.0, -1.0, -1.0}, last_signal{};
    for (int x = 0; x < received.size.x; ++x) {
        const auto light = prediction.shown_light_at(x, y);
        const auto& levels = received.at(x, y);
        for (std::size_t channel = 0; channel < channels; ++channel) {
            if (light[channel] != last_light[channel]) {
                last_light[channel] = light[channel];
                last_signal[channel] = prediction.signal_of(channel, light[channel], received);
            }
            const double signal = last_signal[channel];
            const int level = levels[channel];
            int difference = 0;
            if (dithered) {
                // One of the two levels around the signal; on a level, that one. A code of 16 bits may lie to
                // the other side of a level than what it stands for.
                const double slack = 0.51 * received.highest / 65535.0;
                const int low = static_cast<int>(std::floor(signal - slack)),
                          high = static_cast<int>(std::ceil(signal + slack));
                difference = level < low ? low - level : level > high ? level - high : 0;
            } else {
                difference = std::abs(level - static_cast<int>(std::floor(signal + 0.5 + 1e-9)));
            }
            ++found.compared;
            if (difference == 0)
                continue;
            if (found.different++ == 0) {
                found.first = fmt::format("({}, {}) {}: received {}, predicted {:.6f}", x, y, "RGB"[channel],
                                          level, signal);
            }
            found.largest_difference = std::max(found.largest_difference, difference);
        }
    }
    return found;
}

/// The largest error of the mean over tiles in which the light is the same everywhere.
double worst_mean(const ReceivedLight& received, const SignalPrediction& prediction, int first_row) {
    constexpr int tile_px = 64;
    double worst = 0.0;
    for (int top = first_row; top + tile_px <= received.size.y; top += tile_px) {
        for (int left = 0; left + tile_px <= received.size.x; left += tile_px) {
            const auto light = prediction.shown_light_at(left, top);
            std::array<std::int64_t, 3> sums{};
            bool plain = true;
            for (int y = top; y < top + tile_px && plain; ++y) {
                for (int x = left; x < left + tile_px && plain; ++x) {
                    plain = prediction.shown_light_at(x, y) == light;
                    for (std::size_t channel = 0; channel < 3; ++channel)
                        sums[channel] += received.at(x, y)[channel];
                }
            }
            for (std::size_t channel = 0; plain && channel < 3; ++channel) {
                // What the eye takes in is light: the share of the higher level is that of the light's way
                // between the light of both.
                const double signal = prediction.signal_of(channel, light[channel], received);
                const double low = std::min(std::floor(signal), received.highest - 1.0);
                const auto light_of = [&](double level) {
                    double below = 0.0, above = 1.0; // inverted by halving: the signal is monotone
                    for (int i = 0; i < 60; ++i) {
                        const double middle = 0.5 * (below + above);
                        (prediction.signal_of(channel, middle, received) < level ? below : above) = middle;
                    }
                    return 0.5 * (below + above);
                };
                const double share = (light[channel] - light_of(low)) / (light_of(low + 1.0) - light_of(low));
                const double scale = 65535.0 / received.highest;
                const double code = std::floor((low + share) * scale + 0.5);
                const double mean = static_cast<double>(sums[channel]) / (tile_px * tile_px);
                worst = std::max(worst, std::abs(mean * scale - code));
            }
        }
    }
    return worst;
}

} // namespace

SignalFindings& SignalFindings::operator+=(const SignalFindings& other) {
    if (different == 0)
        first = other.first;
    compared += other.compared;
    different += other.different;
    largest_difference = std::max(largest_difference, other.largest_difference);
    largest_mean_error = std::max(largest_mean_error, other.largest_mean_error);
    return *this;
}

SignalFindings check_signal(const SignalScreen& screen, const DisplaySettings& display,
                            const ShownPicture& shown) {
    const ReceivedLight received = receive_light(screen, display.output);
    const SignalPrediction prediction(display, shown);
    const int first_row = reserved_rows(display.output);
    const bool dithered = display.dither != Dithering::none;
    std::vector<SignalFindings> rows(static_cast<std::size_t>(std::max(0, received.size.y - first_row)));
    parallel_for(static_cast<int>(rows.size()), [&](int i) {
        rows[static_cast<std::size_t>(i)] = check_row(received, prediction, dithered, first_row + i);
    });
    SignalFindings found;
    for (const SignalFindings& row : rows)
        found += row;
    if (dithered)
        found.largest_mean_error = worst_mean(received, prediction, first_row);
    return found;
}

} // namespace overt
