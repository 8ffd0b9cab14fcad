#include "experiment/screen_areas/screen_area.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

/// Counts the edges that a line from the point to the right crosses.
bool is_in_polygon(const std::vector<ScreenPoint>& corners, ScreenPoint point) {
    bool inside = false;
    for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
        const ScreenPoint a = corners[i], b = corners[before];
        if ((a.y_px > point.y_px) != (b.y_px > point.y_px) &&
            point.x_px < a.x_px + (b.x_px - a.x_px) * (point.y_px - a.y_px) / (b.y_px - a.y_px))
            inside = !inside;
    }
    return inside;
}

} // namespace

bool ScreenArea::contains(ScreenPoint point) const {
    if (shape == Shape::polygon)
        return is_in_polygon(points, point);
    const ScreenPoint low = points[0], high = points[1];
    if (shape == Shape::rectangle)
        return point.x_px >= low.x_px && point.x_px < high.x_px && point.y_px >= low.y_px &&
               point.y_px < high.y_px;
    const double x = (2.0 * point.x_px - low.x_px - high.x_px) / (high.x_px - low.x_px),
                 y = (2.0 * point.y_px - low.y_px - high.y_px) / (high.y_px - low.y_px);
    return x * x + y * y <= 1.0;
}

std::int64_t pixels_in(std::span<const ScreenArea* const> shapes, glm::ivec2 screen_px) {
    std::int64_t pixels = 0;
    double top = screen_px.y, bottom = 0.0, left = screen_px.x, right = 0.0;
    for (const ScreenArea* shape : shapes) {
        for (const ScreenPoint& point : shape->points) {
            top = std::min(top, point.y_px);
            bottom = std::max(bottom, point.y_px);
            left = std::min(left, point.x_px);
            right = std::max(right, point.x_px);
        }
    }
    const auto within = [](double px, int most) {
        return static_cast<int>(std::clamp(px, 0.0, double{1} * most));
    };
    const int last_row = within(std::ceil(bottom), screen_px.y),
              last_column = within(std::ceil(right), screen_px.x);
    for (int row = within(std::floor(top), screen_px.y); row < last_row; ++row) {
        for (int column = within(std::floor(left), screen_px.x); column < last_column; ++column) {
            const ScreenPoint middle{column + 0.5, row + 0.5};
            pixels +=
                std::ranges::any_of(shapes, [&](const ScreenArea* shape) { return shape->contains(middle); });
        }
    }
    return pixels;
}

} // namespace overt
