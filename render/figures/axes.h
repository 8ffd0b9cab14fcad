/// The frame of a chart: two axes with ticks and units.
#pragma once

#include <string>
#include <vector>

#include "render/figures/pen.h"

namespace overt {

/// Values at even steps of 1, 2 or 5 times a power of ten, from low to high.
std::vector<double> tick_values(double low, double high, int wanted);

/// A number as a tick has it: up to six digits, no trailing zeros.
std::string tick_text(double value);

struct AxisRange {
    double low = 0.0, high = 1.0;
    std::string label; ///< with its unit; empty: neither ticks nor label
    bool is_logarithmic = false;
    bool is_whole = false; ///< counts something: no ticks between whole numbers
};

/// The ticks that fit an axis of so many millimetres beside each other, with letters of `tick_points`:
/// `is_upwards` says whether the numbers stand one above the other. One at least.
std::vector<double> ticks_that_fit(const AxisRange& range, double length_mm, bool is_upwards);

inline constexpr double tick_points = 6.5, axis_points = 7.5;

class ChartAxes {
  public:
    /// Draws the axes into the box from `corner` of `size`, numbers and labels included: room for them is
    /// taken from the box as they need it, a label that is longer than its axis gets several lines.
    ChartAxes(FigurePen& pen, glm::dvec2 corner, glm::dvec2 size, AxisRange x, AxisRange y);

    glm::dvec2 place(double x, double y) const { return {across(x), up(y)}; }
    double across(double x) const { return left_ + share(x_, x) * (right_ - left_); }
    double up(double y) const { return floor_ - share(y_, y) * (floor_ - top_); }
    double left() const { return left_; }
    double right() const { return right_; }
    double top() const { return top_; }
    double floor() const { return floor_; }

  private:
    static double share(const AxisRange& range, double value);
    AxisRange x_, y_;
    double left_, right_, top_, floor_;
};

} // namespace overt
