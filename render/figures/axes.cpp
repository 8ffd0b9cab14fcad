#include "render/figures/axes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace overt {

std::vector<double> tick_values(double low, double high, int wanted) {
    if (!(high > low))
        return {low};
    const double raw = (high - low) / std::max(1, wanted);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
        if (factor * power >= raw * (1.0 - 1e-9))
            step = factor * power;
    }
    std::vector<double> values;
    for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n)
        values.push_back(n * step);
    return values;
}

std::string tick_text(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0.0 : value); }

double ChartAxes::share(const AxisRange& range, double value) {
    const auto of = [&](double v) { return range.is_logarithmic ? std::log10(v) : v; };
    const double extent = of(range.high) - of(range.low);
    return extent > 0.0 ? (of(value) - of(range.low)) / extent : 0.0;
}

ChartAxes::ChartAxes(FigurePen& pen, glm::dvec2 corner, glm::dvec2 size, AxisRange x, AxisRange y)
    : x_(std::move(x)), y_(std::move(y)), left_(corner.x + 13.0), right_(corner.x + size.x - 2.0),
      top_(corner.y + 3.0), floor_(corner.y + size.y - 9.5) {
    const auto ticks_of = [](const AxisRange& range, int wanted) {
        if (!range.is_logarithmic)
            return tick_values(range.low, range.high, wanted);
        std::vector<double> decades;
        for (int p = static_cast<int>(std::ceil(std::log10(range.low))); p <= std::log10(range.high); ++p)
            decades.push_back(std::pow(10.0, p));
        return decades;
    };
    for (const double value : ticks_of(y_, static_cast<int>((floor_ - top_) / 9.0))) {
        pen.line({left_ - 1.0, up(value)}, {left_, up(value)});
        pen.text({left_ - 1.6, up(value) + 0.9}, tick_text(value), 6.5, TextAlign::right);
    }
    pen.text({corner.x + 3.2, 0.5 * (top_ + floor_)}, y_.label, 7.5, TextAlign::centre, figure_ink, true);
    if (!x_.label.empty()) {
        for (const double value : ticks_of(x_, static_cast<int>((right_ - left_) / 14.0))) {
            pen.line({across(value), floor_}, {across(value), floor_ + 1.0});
            pen.text({across(value), floor_ + 3.8}, tick_text(value), 6.5, TextAlign::centre);
        }
        pen.text({0.5 * (left_ + right_), corner.y + size.y - 1.0}, x_.label, 7.5, TextAlign::centre);
    }
    pen.path({{left_, top_}, {left_, floor_}, {right_, floor_}}, figure_ink, 0.25);
}

} // namespace overt
