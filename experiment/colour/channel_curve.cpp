#include "experiment/colour/channel_curve.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {

namespace {

double clipped(double value) { return value > 0.0 ? (value < 1.0 ? value : 1.0) : 0.0; }

/// Slopes at the points: 0 at a turn or a flat, else the weighted harmonic mean of both sides.
std::vector<double> slopes_of(const std::vector<double>& x, const std::vector<double>& y) {
    const std::size_t last = x.size() - 1;
    std::vector<double> width(last), rise(last), slopes(x.size());
    for (std::size_t i = 0; i < last; ++i) {
        width[i] = x[i + 1] - x[i];
        rise[i] = (y[i + 1] - y[i]) / width[i];
    }
    if (last == 1)
        return {rise[0], rise[0]};
    for (std::size_t i = 1; i < last; ++i) {
        const double before = 2.0 * width[i] + width[i - 1], after = width[i] + 2.0 * width[i - 1];
        if (rise[i - 1] > 0.0 && rise[i] > 0.0)
            slopes[i] = (before + after) / (before / rise[i - 1] + after / rise[i]);
    }
    // At the ends, that of the parabola through three points, as far as it keeps the curve from turning.
    const auto end_slope = [](double near_width, double far_width, double near_rise, double far_rise) {
        const double slope =
            ((2.0 * near_width + far_width) * near_rise - near_width * far_rise) / (near_width + far_width);
        return std::clamp(slope, 0.0, 3.0 * near_rise);
    };
    slopes[0] = end_slope(width[0], width[1], rise[0], rise[1]);
    slopes[last] = end_slope(width[last - 1], width[last - 2], rise[last - 1], rise[last - 2]);
    return slopes;
}

} // namespace

ChannelCurve ChannelCurve::power(double exponent, double offset) {
    OVERT_EXPECTS(exponent >= 0.1 && exponent <= 10.0 && std::abs(offset) <= 0.9);
    ChannelCurve curve;
    curve.exponent_ = exponent;
    curve.offset_ = offset;
    return curve;
}

ChannelCurve ChannelCurve::table(std::vector<double> signals, std::vector<double> lights, double exponent) {
    OVERT_EXPECTS(signals.size() >= 2 && signals.size() == lights.size());
    OVERT_EXPECTS(signals.front() == 0.0 && signals.back() == 1.0);
    OVERT_EXPECTS(lights.front() == 0.0 && lights.back() == 1.0);
    OVERT_EXPECTS(std::is_sorted(signals.begin(), signals.end(), std::less_equal<>()));
    OVERT_EXPECTS(std::is_sorted(lights.begin(), lights.end()));
    ChannelCurve curve = power(exponent);
    for (const double light : lights)
        curve.heights_.push_back(std::pow(light, 1.0 / exponent));
    curve.slopes_ = slopes_of(signals, curve.heights_);
    curve.signals_ = std::move(signals);
    curve.lights_ = std::move(lights);
    return curve;
}

double ChannelCurve::light_of(double signal) const noexcept {
    const double inside = clipped(signal);
    if (!is_table()) {
        const auto power_of = [this](double s) {
            return std::pow(std::max(0.0, (1.0 - offset_) * s + offset_), exponent_);
        };
        const double black = offset_ > 0.0 ? power_of(0.0) : 0.0;
        return clipped((power_of(inside) - black) / (1.0 - black));
    }
    const auto above = std::upper_bound(signals_.begin() + 1, signals_.end() - 1, inside);
    const auto i = static_cast<std::size_t>(above - signals_.begin()) - 1;
    const double width = signals_[i + 1] - signals_[i], t = (inside - signals_[i]) / width;
    // Hermite's form.
    const double rise = heights_[i + 1] - heights_[i];
    const double a = width * slopes_[i] - rise, b = rise - width * slopes_[i + 1];
    const double height =
        (1.0 - t) * heights_[i] + t * heights_[i + 1] + t * (1.0 - t) * ((1.0 - t) * a + t * b);
    return clipped(std::pow(clipped(height), exponent_));
}

double nearest_exponent(const std::vector<double>& signals, const std::vector<double>& lights) {
    double products = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        if (!(signals[i] > 0.0 && signals[i] < 1.0 && lights[i] > 0.0))
            continue;
        products += std::log(signals[i]) * std::log(lights[i]);
        squares += std::log(signals[i]) * std::log(signals[i]);
    }
    return squares > 0.0 ? std::clamp(products / squares, 0.1, 10.0) : 1.0;
}

} // namespace overt
