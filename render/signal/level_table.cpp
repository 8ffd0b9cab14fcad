#include "render/signal/level_table.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {

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
    std::vector<double> borders;
    for (int level = 1; level <= levels_; ++level)
        add(borders, curve((level - half) / levels_));
    const auto number_of = [](double light) { return std::bit_cast<std::uint64_t>(light) >> below_bucket; };
    // A curve may be flat at its beginning: where the light of borders is 0, nothing is to be found.
    const auto lit = std::upper_bound(borders.begin(), borders.end(), 0.0);
    level_after_zero_ = static_cast<int>(lit - borders.begin());
    first_bucket_ = number_of(lit == borders.end() ? 1.0 : *lit);
    buckets_.resize(number_of(1.0) - first_bucket_ + 1);
    for (Bucket& bucket : buckets_)
        bucket.first = level_after_zero_;
    for (auto border = lit; border != borders.end(); ++border) {
        const std::uint64_t number = number_of(std::min(*border, 1.0)) - first_bucket_;
        ++buckets_[number].count;
    }
    for (std::size_t i = 1; i < buckets_.size(); ++i)
        buckets_[i].first = buckets_[i - 1].first + buckets_[i - 1].count;
    bounded_.assign(1, -1.0);
    bounded_.insert(bounded_.end(), borders.begin(), borders.end());
    bounded_.push_back(2.0);
}

/// Where the curve is flat, the smallest level that makes this light.
int LevelTable::searched(double light) const noexcept {
    return static_cast<int>(std::lower_bound(bounded_.begin() + 1, bounded_.end() - 1, light) -
                            (bounded_.begin() + 1));
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
