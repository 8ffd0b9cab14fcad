#include "experiment/design/probe_marks.h"

#include <cmath>
#include <numbers>

namespace overt {

StimulusMark probe_mark(const ProbeSettings& probe, double px_per_deg) {
    StimulusMark mark;
    mark.light = probe.light;
    mark.rim_px = probe.rim_deg * px_per_deg;
    if (probe.mark == ProbeMark::none)
        return mark;
    mark.count = 1;
    MarkLine& line = mark.lines[0];
    const double diameter = probe.size_deg * px_per_deg;
    line.count = probe.mark == ProbeMark::dot ? 1 : MarkLine::most_points;
    line.width_px = probe.mark == ProbeMark::dot ? diameter : probe.line_deg * px_per_deg;
    for (std::size_t i = 0; i < line.count && line.count > 1; ++i) {
        const double turn =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(line.count - 1);
        line.points[i] = {0.5 * diameter * std::cos(turn), 0.5 * diameter * std::sin(turn)};
    }
    return mark;
}

StimulusMark moved_to(const StimulusMark& mark, ScreenPoint at) noexcept {
    StimulusMark moved = mark;
    for (std::size_t i = 0; i < moved.count; ++i)
        for (std::size_t k = 0; k < moved.lines[i].count; ++k) {
            moved.lines[i].points[k].x_px += at.x_px;
            moved.lines[i].points[k].y_px += at.y_px;
        }
    return moved;
}

StimulusMark gauge_mark(const ProbeView& view, const SeenProbe& at, const Attitude& attitude,
                        double radius_px, double line_px, bool of_other_eye) {
    const auto on_screen = [&](const glm::dvec3& position) {
        return of_other_eye ? view.in_other_eye(position) : view.on_screen(position);
    };
    // Of the length that has so many pixels in the depth of the place.
    const double radius = radius_px * -at.position.z / view.px_at_unit_depth;
    const glm::dvec3 normal = frame_of_sight(at.position) * normal_of(attitude);
    const glm::dvec3 aside = std::abs(normal.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, aside)), v = glm::cross(normal, u);
    StimulusMark mark;
    mark.count = 2;
    MarkLine& circle = mark.lines[0];
    circle.width_px = line_px;
    circle.count = MarkLine::most_points;
    for (std::size_t i = 0; i < circle.count; ++i) {
        const double turn =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(circle.count - 1);
        circle.points[i] = on_screen(at.position + radius * (std::cos(turn) * u + std::sin(turn) * v));
    }
    MarkLine& rod = mark.lines[1];
    rod.width_px = line_px;
    rod.count = 2;
    rod.points[0] = on_screen(at.position);
    rod.points[1] = on_screen(at.position + radius * normal);
    return mark;
}

} // namespace overt
