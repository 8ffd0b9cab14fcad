#include "render/figures/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace overt {
namespace {

constexpr double legend_points = 6.5, sample_mm = 8.0, sample_gap_mm = 1.2, item_gap_mm = 4.0;

std::vector<glm::dvec2> regular(glm::dvec2 centre, int corners, double radius_mm, double turn) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * (turn + static_cast<double>(i) / corners);
        points.push_back(centre + radius_mm * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

// A cross of two bars, turned by a share of a circle.
void draw_cross(FigurePen& pen, glm::dvec2 centre, FigureColour colour, double turn) {
    for (const double quarter : {0.0, 0.25}) {
        const double angle = 2.0 * std::numbers::pi * (turn + quarter);
        const glm::dvec2 reach = 0.95 * glm::dvec2(std::cos(angle), std::sin(angle));
        pen.line(centre - reach, centre + reach, colour, 0.45);
    }
}

} // namespace

void CurveStyle::draw_curve(FigurePen& pen, const std::vector<glm::dvec2>& points) const {
    static const std::array<std::vector<double>, 4> dashes{
        std::vector<double>{}, {2.0, 0.9}, {0.5, 0.8}, {2.6, 0.8, 0.5, 0.8}};
    if (points.size() > 1)
        pen.path(points, colour(), 0.4, dashes[number_ / figure_colours % dashes.size()]);
}

void CurveStyle::draw_marker(FigurePen& pen, glm::dvec2 centre) const {
    switch (number_ % 7) {
    case 0:
        pen.dot(centre, 0.75, colour());
        break;
    case 1:
        pen.polygon(regular(centre, 4, 0.95, 0.125), colour());
        break;
    case 2:
        pen.polygon(regular(centre, 3, 1.0, 0.75), colour());
        break;
    case 3:
        pen.polygon(regular(centre, 4, 1.0, 0.0), colour());
        break;
    case 4:
        pen.polygon(regular(centre, 3, 1.0, 0.25), colour());
        break;
    case 5:
        draw_cross(pen, centre, colour(), 0.0);
        break;
    default:
        draw_cross(pen, centre, colour(), 0.125);
        break;
    }
}

FigureLegend::FigureLegend(std::vector<std::string> names, double width_mm) {
    const double most = width_mm - sample_mm - sample_gap_mm;
    double widest = 0.0;
    for (const std::string& name : names) {
        items_.push_back({broken_into_lines(name, legend_points, most), {}});
        for (const std::string& line : items_.back().lines)
            widest = std::max(widest, extent_of(line, legend_points).width);
    }
    const double item = sample_mm + sample_gap_mm + widest;
    const auto columns =
        static_cast<std::size_t>(std::max(1.0, std::floor((width_mm + item_gap_mm) / (item + item_gap_mm))));
    double line_height = 0.0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (i % columns == 0) {
            height_mm_ += line_height;
            line_height = 0.0;
        }
        items_[i].place = {static_cast<double>(i % columns) * (item + item_gap_mm), height_mm_};
        line_height = std::max(line_height, height_of(items_[i].lines, legend_points) + 0.3);
    }
    height_mm_ += line_height;
}

void FigureLegend::draw(FigurePen& pen, glm::dvec2 corner) const {
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const glm::dvec2 at = corner + items_[i].place;
        const double middle = at.y + 0.5 * extent_of(items_[i].lines.front(), legend_points).height();
        const CurveStyle style(i);
        style.draw_curve(pen, {{at.x, middle}, {at.x + sample_mm, middle}});
        style.draw_marker(pen, {at.x + 0.5 * sample_mm, middle});
        draw_lines(pen, {at.x + sample_mm + sample_gap_mm, at.y}, items_[i].lines, legend_points);
    }
}

} // namespace overt
