#include "render/signal/level_table.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr int ranges = 65536;

/// Also for what is not a number.
double clipped(double light) { return light > 0.0 ? (light < 1.0 ? light : 1.0) : 0.0; }

} // namespace

LevelTable::LevelTable(int levels, double gamma) : levels_(levels), linear_(gamma == 1.0) {
    OVERT_EXPECTS(levels >= 1 && levels <= 65535 && gamma > 0.0);
    if (!linear_)
        tabulate([gamma](double signal) { return std::pow(signal, gamma); });
}

LevelTable::LevelTable(int levels, const std::function<double(double)>& curve)
    : levels_(levels), linear_(false) {
    OVERT_EXPECTS(levels >= 1 && levels <= 65535 && curve(0.0) == 0.0 && curve(1.0) == 1.0);
    tabulate(curve);
}

void LevelTable::tabulate(const std::function<double(double)>& curve) {
    // The last digit of a curve may fall where the curve does not.
    const auto add = [](std::vector<double>& lights, double light) {
        lights.push_back(lights.empty() ? light : std::max(lights.back(), light));
    };
    for (int level = 0; level <= levels_; ++level)
        add(lights_, curve(static_cast<double>(level) / levels_));
    for (int level = 1; level <= levels_; ++level)
        add(borders_, curve((level - half) / levels_));
    for (int range = 0; range <= ranges; ++range) {
        const double begin = static_cast<double>(range) / ranges;
        first_of_range_.push_back(
            static_cast<int>(std::lower_bound(borders_.begin(), borders_.end(), begin) - borders_.begin()));
    }
}

int LevelTable::level_of(double light) const noexcept {
    const double inside = clipped(light);
    if (linear_)
        return static_cast<int>(inside * levels_ + half);
    const auto range = static_cast<std::size_t>(inside * ranges);
    const auto last = range < ranges ? borders_.begin() + first_of_range_[range + 1] : borders_.end();
    const auto first = borders_.begin() + first_of_range_[range];
    // Where the curve is flat, the smallest level that makes this light.
    return static_cast<int>(std::lower_bound(first, last, inside) - borders_.begin());
}

double LevelTable::position_of(double light) const noexcept {
    const double inside = clipped(light);
    if (linear_)
        return inside * levels_;
    int level = level_of(inside);
    if (light_of(level) > inside)
        --level;
    if (level == levels_)
        return levels_;
    const double step = light_of(level + 1) - light_of(level);
    return step > 0.0 ? level + (inside - light_of(level)) / step : level;
}

} // namespace overt
