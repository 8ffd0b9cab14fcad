#include "render/figures/power_figure.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/figures/axes.h"

namespace overt {

namespace {

void dashed_line(FigurePen& pen, double from, double to, double y) {
    constexpr double dash_mm = 1.2;
    while (from < to) {
        pen.line({from, y}, {std::min(from + dash_mm, to), y}, figure_grey, 0.25);
        from += 2.0 * dash_mm;
    }
}

} // namespace

void write_power_figure(const PowerResults& results, const std::filesystem::path& folder) {
    if (results.curves.empty())
        return;
    const std::vector<PowerPoint>& points = results.curves.front().points;
    constexpr double chart_mm = 66.0, line_mm = 3.6;
    const glm::dvec2 size(page_mm, chart_mm + 3.0 + line_mm * static_cast<double>(results.curves.size()));
    save_figure(folder, "power_curve", size, [&](FigurePen& pen) {
        const double first = points.front().observers, last = points.back().observers;
        const double margin = std::max(0.5, 0.04 * (last - first));
        const ChartAxes axes(pen, {0.0, 0.0}, {page_mm, chart_mm},
                             {first - margin, last + margin, "observers", false},
                             {0.0, 1.0, fmt::format("share of {} studies", results.studies), false});
        for (const auto& [share, words] :
             {std::pair(results.target, "asked for"), {results.alpha, "alpha"}}) {
            dashed_line(pen, axes.left(), axes.right(), axes.up(share));
            pen.text({axes.right() - 0.5, axes.up(share) - 0.8}, words, 5.5, TextAlign::right, figure_grey);
        }
        for (std::size_t c = 0; c < results.curves.size(); ++c) {
            const PowerCurve& curve = results.curves[c];
            // Side by side, so that intervals do not hide each other.
            const double aside =
                0.7 * (static_cast<double>(c) - 0.5 * static_cast<double>(results.curves.size() - 1));
            std::vector<glm::dvec2> path;
            for (const PowerPoint& point : curve.points) {
                const glm::dvec2 place(axes.across(point.observers) + aside, axes.up(point.share()));
                path.push_back(place);
                pen.line({place.x, axes.up(point.interval.low)}, {place.x, axes.up(point.interval.high)},
                         figure_colour(c), 0.25);
                pen.dot(place, 0.7, figure_colour(c));
            }
            if (path.size() > 1)
                pen.path(path, figure_colour(c), 0.4);
            const double y = chart_mm + 3.0 + line_mm * static_cast<double>(c);
            pen.line({12.0, y - 0.8}, {17.0, y - 0.8}, figure_colour(c), 0.5);
            pen.dot({14.5, y - 0.8}, 0.7, figure_colour(c));
            pen.text({19.0, y}, curve.effect.text(), 6.5);
        }
    });
}

} // namespace overt
