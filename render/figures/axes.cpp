#include "render/figures/axes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace overt {
namespace {

constexpr double tick_mm = 1.0, tick_gap_mm = 0.6, label_gap_mm = 0.8;

double position_on(const AxisRange& range, double value) {
    const auto of = [&](double v) { return range.is_logarithmic ? std::log10(v) : v; };
    const double extent = of(range.high) - of(range.low);
    return extent > 0.0 ? (of(value) - of(range.low)) / extent : 0.0;
}

// Decades, and between them 2 and 5 where there are less than three.
std::vector<double> logarithmic_ticks(double low, double high) {
    std::vector<double> decades, all;
    for (int p = static_cast<int>(std::floor(std::log10(low))); p <= std::log10(high) + 1.0; ++p) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double value = factor * std::pow(10.0, p);
            if (value < low * (1.0 - 1e-9) || value > high * (1.0 + 1e-9))
                continue;
            all.push_back(value);
            if (factor < 1.5)
                decades.push_back(value);
        }
    }
    return decades.size() < 3 && !all.empty() ? all : decades;
}

} // namespace

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

std::string tick_text(double value) {
    return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value); // there is a -0, too
}

std::vector<double> ticks_that_fit(const AxisRange& range, double length_mm, bool is_upwards) {
    std::vector<double> values;
    const int most = is_upwards ? 7 : 8;
    for (int wanted = most; wanted > 0; --wanted) {
        values = range.is_logarithmic ? logarithmic_ticks(range.low, range.high)
                                      : tick_values(range.low, range.high, wanted);
        if (range.is_whole)
            std::erase_if(values, [](double v) { return std::abs(v - std::round(v)) > 1e-6; });
        // Of an axis of logarithms each second one, each third one.
        if (range.is_logarithmic && !values.empty()) {
            std::vector<double> fewer;
            for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(most - wanted + 1))
                fewer.push_back(values[i]);
            values = fewer;
        }
        bool do_fit = true;
        double end = -1e9;
        for (const double value : values) {
            const TextExtent extent = extent_of(tick_text(value), tick_points);
            const double half = 0.5 * (is_upwards ? extent.height() : extent.width),
                         at = position_on(range, value) * length_mm;
            do_fit = do_fit && at - half > end;
            end = at + half + (is_upwards ? 0.4 : 1.5);
        }
        if (do_fit && !values.empty())
            return values;
    }
    return {values.empty() ? range.low : values.front()};
}

double ChartAxes::share(const AxisRange& range, double value) { return position_on(range, value); }

ChartAxes::ChartAxes(FigurePen& pen, glm::dvec2 corner, glm::dvec2 size, AxisRange x, AxisRange y)
    : x_(std::move(x)), y_(std::move(y)) {
    const auto width_of = [](const std::vector<double>& values) {
        double widest = 0.0;
        for (const double value : values)
            widest = std::max(widest, extent_of(tick_text(value), tick_points).width);
        return widest;
    };
    const double tick_height = extent_of("0", tick_points).height();
    // From the outside to the inside: what stands at the bottom decides how high the axis upwards is, whose
    // numbers decide how long the one across is.
    top_ = corner.y + 0.5 * tick_height + 0.5;
    const bool has_x = !x_.label.empty();
    const std::vector<std::string> x_lines =
        has_x ? broken_into_lines(x_.label, axis_points, 0.8 * size.x) : std::vector<std::string>{};
    const double below =
        has_x ? tick_mm + tick_gap_mm + tick_height + label_gap_mm + height_of(x_lines, axis_points) + 0.3
              : 0.5 * tick_height + 0.5;
    floor_ = corner.y + size.y - below;
    const std::vector<double> y_ticks = ticks_that_fit(y_, floor_ - top_, true);
    const std::vector<std::string> y_lines = broken_into_lines(y_.label, axis_points, floor_ - top_);
    left_ = corner.x + 0.5 + (y_.label.empty() ? 0.0 : height_of(y_lines, axis_points) + label_gap_mm) +
            width_of(y_ticks) + tick_gap_mm + tick_mm;
    right_ = corner.x + size.x - 2.0;
    std::vector<double> x_ticks;
    if (has_x) {
        x_ticks = ticks_that_fit(x_, 0.9 * (right_ - left_), false);
        const double half = 0.5 * width_of(x_ticks) + 0.5;
        left_ = std::max(left_, corner.x + half);
        right_ = std::min(right_, corner.x + size.x - half);
    }

    for (const double value : y_ticks) {
        const TextExtent extent = extent_of(tick_text(value), tick_points);
        pen.line({left_ - tick_mm, up(value)}, {left_, up(value)});
        pen.text({left_ - tick_mm - tick_gap_mm, up(value) - 0.5 * extent.height() + extent.above},
                 tick_text(value), tick_points, TextAlign::right);
    }
    double at = corner.x + 0.5;
    for (const std::string& line : y_lines) {
        const TextExtent extent = extent_of(line, axis_points);
        pen.text({at + extent.above, 0.5 * (top_ + floor_)}, line, axis_points, TextAlign::centre, figure_ink,
                 true);
        at += extent.height();
    }
    if (has_x) {
        const double baseline = floor_ + tick_mm + tick_gap_mm + extent_of("0", tick_points).above;
        for (const double value : x_ticks) {
            pen.line({across(value), floor_}, {across(value), floor_ + tick_mm});
            pen.text({across(value), baseline}, tick_text(value), tick_points, TextAlign::centre);
        }
        double widest = 0.0;
        for (const std::string& line : x_lines)
            widest = std::max(widest, extent_of(line, axis_points).width);
        const double middle = std::min(0.5 * (left_ + right_), corner.x + size.x - 0.5 - 0.5 * widest);
        draw_lines(pen, {middle, floor_ + tick_mm + tick_gap_mm + tick_height + label_gap_mm}, x_lines,
                   axis_points, TextAlign::centre);
    }
    pen.path({{left_, top_}, {left_, floor_}, {right_, floor_}}, figure_ink, 0.25);
}

} // namespace overt
