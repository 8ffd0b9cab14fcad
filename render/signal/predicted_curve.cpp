#include "render/signal/predicted_curve.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

/// Slope of a curve at a point, from the points around it.
double slope_at(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) {
    const std::size_t last = x.size() - 1;
    const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
    if (last == 1)
        return secant(0);
    if (i == 0 || i == last) {
        const std::size_t near = i == 0 ? 0 : last - 1, far = i == 0 ? 1 : last - 2;
        const double here = x[near + 1] - x[near], there = x[far + 1] - x[far];
        const double parabola = secant(near) + here / (here + there) * (secant(near) - secant(far));
        return std::min(std::max(parabola, 0.0), 3.0 * secant(near));
    }
    const double left = secant(i - 1), right = secant(i);
    if (!(left * right > 0.0))
        return 0.0;
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double share = (before + 2.0 * after) / (3.0 * (before + after));
    return left * right / (share * right + (1.0 - share) * left);
}

double on(const std::array<double, 4>& p, double t) {
    const double u = 1.0 - t;
    return u * u * u * p[0] + 3.0 * u * u * t * p[1] + 3.0 * u * t * t * p[2] + t * t * t * p[3];
}

} // namespace

PredictedCurve::PredictedCurve(const ChannelCurve& measured)
    : exponent_(measured.exponent()), offset_(measured.offset()) {
    if (!measured.is_table()) {
        black_ = offset_ > 0.0 ? std::pow(offset_, exponent_) : 0.0;
        return;
    }
    const std::vector<double>& x = measured.signals();
    std::vector<double> y;
    for (const double light : measured.lights())
        y.push_back(std::pow(light, 1.0 / exponent_));
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double third = (x[i + 1] - x[i]) / 3.0;
        pieces_.push_back(
            {x[i],
             x[i + 1],
             {y[i], y[i] + third * slope_at(x, y, i), y[i + 1] - third * slope_at(x, y, i + 1), y[i + 1]}});
    }
}

double PredictedCurve::signal_of(double light) const {
    if (!(light > 0.0))
        return 0.0;
    if (pieces_.empty()) {
        const double base = std::pow(black_ + light * (1.0 - black_), 1.0 / exponent_);
        return (base - offset_) / (1.0 - offset_);
    }
    const double root = std::pow(light, 1.0 / exponent_);
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && pieces_[i].polygon[3] < root)
        ++i;
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 52; ++step) {
        const double middle = 0.5 * (low + high);
        (on(pieces_[i].polygon, middle) < root ? low : high) = middle;
    }
    return pieces_[i].begin + high * (pieces_[i].end - pieces_[i].begin);
}

double PredictedCurve::light_of(double signal) const {
    if (pieces_.empty()) {
        const double base = std::max(0.0, signal + offset_ * (1.0 - signal));
        return (std::pow(base, exponent_) - black_) / (1.0 - black_);
    }
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && pieces_[i].end < signal)
        ++i;
    const Piece& piece = pieces_[i];
    return std::pow(on(piece.polygon, (signal - piece.begin) / (piece.end - piece.begin)), exponent_);
}

} // namespace overt
