#include "render/bake/pixel_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

constexpr int quantile_count = 1024;

/// Weight at `place` of the width, -0.5 … 0.5.
double weight(PixelFilter filter, double place) {
    const double turn = 2.0 * std::numbers::pi * (place + 0.5);
    switch (filter) {
    case PixelFilter::box:
        return 1.0;
    case PixelFilter::gaussian:
        return std::exp(-0.5 * (6.0 * place) * (6.0 * place));
    case PixelFilter::blackman_harris:
        return 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2.0 * turn) -
               0.01168 * std::cos(3.0 * turn);
    }
    return 1.0;
}

} // namespace

PixelSampling::PixelSampling(PixelFilter filter, double width_px) {
    // Midpoint sums, fine enough that the quantiles are exact to float.
    constexpr int steps = 65536;
    std::vector<double> below(steps + 1, 0.0);
    for (int i = 0; i < steps; ++i)
        below[static_cast<std::size_t>(i) + 1] =
            below[static_cast<std::size_t>(i)] + weight(filter, (i + 0.5) / steps - 0.5);
    quantiles_.resize(quantile_count + 1);
    std::size_t step = 0;
    for (std::size_t i = 0; i < quantiles_.size(); ++i) {
        const double sought = below.back() * static_cast<double>(i) / quantile_count;
        while (step + 2 < below.size() && below[step + 1] < sought)
            ++step;
        const double within = (sought - below[step]) / (below[step + 1] - below[step]);
        const double place = (static_cast<double>(step) + std::clamp(within, 0.0, 1.0)) / steps - 0.5;
        quantiles_[i] = static_cast<float>(place * width_px);
    }
}

float PixelSampling::offset(float place) const {
    const float index = place * static_cast<float>(quantile_count);
    const int below = std::clamp(static_cast<int>(index), 0, quantile_count - 1);
    const float from = quantiles_[static_cast<std::size_t>(below)],
                to = quantiles_[static_cast<std::size_t>(below) + 1];
    return from + (index - static_cast<float>(below)) * (to - from);
}

} // namespace overt
