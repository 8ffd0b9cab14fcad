#include "render/signal/signal_prediction.h"

#include <algorithm>
#include <cmath>

#include "render/signal/mode_coding.h"
#include "render/signal/signal_decoder.h"

namespace overt {

namespace {

constexpr double pi = 3.14159265358979323846;

double lanczos3(double t) {
    if (t == 0.0)
        return 1.0;
    if (std::abs(t) >= 3.0)
        return 0.0;
    return 3.0 * std::sin(pi * t) * std::sin(pi * t / 3.0) / (pi * pi * t * t);
}

} // namespace

SignalPrediction::SignalPrediction(const DisplaySettings& display, const ShownPicture& shown)
    : display_(&display), coding_(&coding_of(display.output)), shown_(shown) {
    if (!display.characterisation)
        return;
    const auto& primaries = display.characterisation->primaries_xyz;
    const double sum = primaries[0].y + primaries[1].y + primaries[2].y;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        luminance_shares_[channel] = primaries[channel].y / sum;
        curves_[channel] = PredictedCurve(display.characterisation->curves[channel]);
    }
}

std::array<double, 3> SignalPrediction::light_at(int x, int y) const {
    const double around = display_->background;
    if (!shown_.picture)
        return {around, around, around};
    const int column = x - shown_.origin_px.x, row = y - shown_.origin_px.y;
    if (column < 0 || row < 0 || column >= shown_.picture->size_px.x || row >= shown_.picture->size_px.y)
        return {around, around, around};
    const glm::vec4& pixel = shown_.picture->at(column, row);
    const double through = (1.0 - double{pixel.a}) * around;
    return {double{pixel.r} + through, double{pixel.g} + through, double{pixel.b} + through};
}

std::array<double, 3> SignalPrediction::pair_light_at(int pair, int y) const {
    std::array<double, 3> colour{};
    if (display_->pair_filter == PairFilter::box) {
        const auto left = light_at(2 * pair, y), right = light_at(2 * pair + 1, y);
        for (std::size_t channel = 0; channel < 3; ++channel)
            colour[channel] = (left[channel] + right[channel]) / 2.0;
        return colour;
    }
    // The middle of the pair is the border between its pixels.
    const double middle = 2.0 * pair + 1.0;
    double weights = 0.0;
    for (int x = 2 * pair - 6; x <= 2 * pair + 7; ++x) {
        const double weight = lanczos3((x + 0.5 - middle) / 2.0);
        const auto light = light_at(x, y);
        weights += weight;
        for (std::size_t channel = 0; channel < 3; ++channel)
            colour[channel] += weight * light[channel];
    }
    for (double& value : colour)
        value /= weights;
    return colour;
}

double SignalPrediction::luminance_at(int x, int y) const {
    const auto [r, g, b] = light_at(x, y);
    const auto [red, green, blue] = luminance_shares_;
    return std::clamp(r * red + g * green + b * blue, 0.0, 1.0);
}

std::array<double, 3> SignalPrediction::shown_light_at(int x, int y) const {
    std::array<double, 3> light = coding_->predict(*this, x, y);
    for (double& value : light)
        value = std::clamp(value, 0.0, 1.0);
    return light;
}

double SignalPrediction::grey_signal_of(double light) const {
    // The channels drawn singly enclose the signal that they need together.
    double low = 1.0, high = 0.0;
    for (const PredictedCurve& curve : curves_) {
        low = std::min(low, curve.signal_of(light));
        high = std::max(high, curve.signal_of(light));
    }
    while (high - low > 1e-15) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high)
            break;
        double sum = 0.0;
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum += luminance_shares_[channel] * curves_[channel].light_of(middle);
        (sum < light ? low : high) = middle;
    }
    return high;
}

double SignalPrediction::signal_of(std::size_t channel, double light, const ReceivedLight& received) const {
    if (!display_->characterisation)
        return received.highest * (display_->gamma == 1.0 ? light : std::pow(light, 1.0 / display_->gamma));
    return received.highest * (received.is_grey ? grey_signal_of(light) : curves_[channel].signal_of(light));
}

} // namespace overt
