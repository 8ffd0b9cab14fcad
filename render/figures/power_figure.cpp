#include "render/figures/power_figure.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/figures/axes.h"
#include "render/figures/legend.h"

namespace overt {

void write_power_figure(const PowerResults& results, const std::filesystem::path& folder) {
    if (results.curves.empty())
        return;
    const std::vector<PowerPoint>& points = results.curves.front().points;
    constexpr double chart_mm = 66.0;
    std::vector<std::string> names;
    for (const PowerCurve& curve : results.curves)
        names.push_back(curve.effect.text());
    const FigureLegend legend(names, page_mm - 2.0);
    const glm::dvec2 size(page_mm, chart_mm + 2.0 + legend.height_mm());
    save_figure(folder,
                {"power_curve", size, [&](FigurePen& pen) {
                     const double first = points.front().observers, last = points.back().observers;
                     const double margin = std::max(0.5, 0.04 * (last - first));
                     const ChartAxes axes(pen, {0.0, 0.0}, {page_mm, chart_mm},
                                          {first - margin, last + margin, "observers", false, true},
                                          {0.0, 1.0, fmt::format("share of {} studies", results.studies)});
                     for (const auto& [share, words] :
                          {std::pair(results.target, "asked for"), {results.alpha, "alpha"}}) {
                         pen.path({{axes.left(), axes.up(share)}, {axes.right(), axes.up(share)}},
                                  figure_grey, 0.25, {1.2, 1.2});
                         pen.text({axes.right() - 0.5, axes.up(share) - 0.8}, words, 5.5, TextAlign::right,
                                  figure_grey);
                     }
                     for (std::size_t c = 0; c < results.curves.size(); ++c) {
                         const PowerCurve& curve = results.curves[c];
                         const CurveStyle style(c);
                         // Side by side, so that intervals do not hide each other.
                         const double aside =
                             std::min(0.7, 8.0 / static_cast<double>(results.curves.size())) *
                             (static_cast<double>(c) - 0.5 * static_cast<double>(results.curves.size() - 1));
                         std::vector<glm::dvec2> path;
                         for (const PowerPoint& point : curve.points) {
                             const glm::dvec2 place(axes.across(point.observers) + aside,
                                                    axes.up(point.share()));
                             path.push_back(place);
                             pen.line({place.x, axes.up(point.interval.low)},
                                      {place.x, axes.up(point.interval.high)}, style.colour(), 0.25);
                             style.draw_marker(pen, place);
                         }
                         style.draw_curve(pen, path);
                     }
                     legend.draw(pen, {1.0, chart_mm + 1.0});
                 }});
}

} // namespace overt
