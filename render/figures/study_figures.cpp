#include "render/figures/study_figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "render/figures/axes.h"
#include "render/figures/legend.h"
#include "render/figures/study_rows.h"

namespace overt {
namespace {

constexpr double title_points = 6.5, title_mm = 4.5;

// A line above the axes, where nothing is drawn.
void draw_title(FigurePen& pen, double right_mm, const std::string& title) {
    pen.text({right_mm, 0.5 + extent_of(title, title_points).above}, title, title_points, TextAlign::right);
}

std::vector<StudyFigure> time_course(const StudyResults& results) {
    double end = 0.0, step = 0.0;
    std::vector<std::string> levels;
    for (const TimeCourseRow& row : results.time_course) {
        if (row.area != results.area || !row.share.value)
            continue;
        end = std::max(end, row.to_s);
        step = std::max(step, row.to_s - row.from_s);
        if (std::find(levels.begin(), levels.end(), row.key.value) == levels.end())
            levels.push_back(row.key.value);
    }
    if (levels.empty())
        return {};
    const double width = levels.size() > 4 ? page_mm : column_mm, chart_mm = levels.size() > 8 ? 90.0 : 62.0;
    const std::string axis =
        fmt::format("share of fixation time on {}", results.area == head_area ? "the head" : results.area);
    const FigureLegend legend(levels, width - 2.0);
    const double top = legend.height_mm() + 2.0;
    return {{"time_course", {width, top + chart_mm}, [=, &results](FigurePen& pen) {
                 legend.draw(pen, {1.0, 1.0});
                 const ChartAxes axes(pen, {0.0, top}, {width, chart_mm}, {0.0, end, "time since onset / s"},
                                      {0.0, 1.0, axis});
                 // Side by side, so that intervals do not hide each other, but within their stretch of time.
                 const auto count = static_cast<double>(levels.size());
                 const double aside = std::min(0.6, 0.7 * (axes.across(step) - axes.across(0.0)) / count);
                 for (std::size_t level = 0; level < levels.size(); ++level) {
                     const CurveStyle style(level);
                     std::vector<glm::dvec2> points;
                     for (const TimeCourseRow& row : results.time_course) {
                         if (row.area != results.area || row.key.value != levels[level] || !row.share.value)
                             continue;
                         const double x = axes.across(0.5 * (row.from_s + row.to_s)) +
                                          aside * (static_cast<double>(level) - 0.5 * (count - 1.0));
                         points.emplace_back(x, axes.up(*row.share.value));
                         if (row.share.interval)
                             pen.line({x, axes.up(std::max(0.0, row.share.interval->low))},
                                      {x, axes.up(std::min(1.0, row.share.interval->high))}, style.colour(),
                                      0.2);
                     }
                     style.draw_curve(pen, points);
                     for (const glm::dvec2& point : points)
                         style.draw_marker(pen, point);
                 }
             }}};
}

std::vector<StudyFigure> fixation_durations(const StudyResults& results) {
    constexpr double bin_ms = 25.0;
    constexpr std::size_t bins = 40;
    std::vector<double> counts(bins, 0.0), durations;
    for (const StudyFixation& fixation : results.fixations) {
        // Where no stimulus is known, no fixation counts on a surface; they last as long all the same.
        const bool is_shown =
            fixation.counted() || (fixation.why == NotCounted::no_stimulus &&
                                   !results.trials[static_cast<std::size_t>(fixation.trial)].excluded);
        if (!is_shown)
            continue;
        durations.push_back(1000.0 * fixation.duration_s);
        counts[std::min(bins - 1, static_cast<std::size_t>(durations.back() / bin_ms))] += 1.0;
    }
    if (durations.empty())
        return {};
    std::nth_element(durations.begin(), durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2),
                     durations.end());
    const std::string title =
        fmt::format("median {:.0f} ms, n = {}", durations[durations.size() / 2], durations.size());
    return {{"fixation_durations", {column_mm, 60.0}, [=](FigurePen& pen) {
                 const ChartAxes axes(
                     pen, {0.0, title_mm}, {column_mm, 60.0 - title_mm},
                     {0.0, bin_ms * bins, "fixation duration / ms (last bar: and longer)", false, true},
                     {0.0, 1.05 * *std::max_element(counts.begin(), counts.end()), "fixations", false, true});
                 for (std::size_t i = 0; i < bins; ++i) {
                     const double x = axes.across(bin_ms * static_cast<double>(i));
                     pen.box(
                         {x + 0.1, axes.up(counts[i])},
                         {axes.across(bin_ms) - axes.across(0.0) - 0.2, axes.floor() - axes.up(counts[i])},
                         figure_colour(0));
                 }
                 draw_title(pen, axes.right(), title);
             }}};
}

// Amplitude and peak velocity of saccades, as their events have them.
std::vector<StudyFigure> main_sequence(const StudyResults& results) {
    std::vector<glm::dvec2> saccades;
    int all = 0;
    for (const StudyTrace& trace : results.traces) {
        for (const StudyTraceEvent& event : trace.events) {
            if (event.kind != GazeEvent::Kind::saccade)
                continue;
            ++all;
            const double amplitude = event.amplitude_deg.value_or(0.0),
                         peak = event.peak_velocity_deg_s.value_or(0.0);
            if (amplitude > 0.0 && peak > 0.0)
                saccades.emplace_back(amplitude, peak);
        }
    }
    if (saccades.empty())
        return {};
    glm::dvec2 low = saccades.front(), high = low;
    for (const glm::dvec2& saccade : saccades) {
        low = glm::min(low, saccade);
        high = glm::max(high, saccade);
    }
    low /= 1.2;
    high *= 1.2;
    const std::string title =
        static_cast<int>(saccades.size()) == all
            ? fmt::format("{} saccades", all)
            : fmt::format("{} of {} saccades: those with a recorded peak", saccades.size(), all);
    return {{"main_sequence", {column_mm, 70.0}, [=](FigurePen& pen) {
                 const ChartAxes axes(pen, {0.0, title_mm}, {column_mm, 70.0 - title_mm},
                                      {low.x, high.x, "saccade amplitude / deg", true},
                                      {low.y, high.y, "peak velocity / (deg/s)", true});
                 // Saccades that a print cannot tell apart are one dot, the darker the more they are: each is
                 // shown, and the file stays small.
                 constexpr double cell_mm = 0.35;
                 std::map<std::pair<int, int>, int> cells;
                 for (const glm::dvec2& saccade : saccades) {
                     const glm::dvec2 place = axes.place(saccade.x, saccade.y) / cell_mm;
                     ++cells[{static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y))}];
                 }
                 for (const auto& [cell, count] : cells)
                     pen.dot({cell_mm * (cell.first + 0.5), cell_mm * (cell.second + 0.5)}, 0.35,
                             figure_colour(5), 1.0 - std::pow(0.6, count));
                 draw_title(pen, axes.right(), title);
             }}};
}

std::vector<StudyFigure> data_quality(const StudyResults& results) {
    if (results.session_quality.empty())
        return {};
    struct Panel {
        const char* label;
        std::optional<double> (*value)(const StudyQuality&);
    };
    static constexpr Panel panels[] = {
        {"accuracy / deg", [](const StudyQuality& q) { return q.accuracy_deg; }},
        {"RMS-S2S / deg", [](const StudyQuality& q) { return q.rms_s2s_deg; }},
        {"SD / deg", [](const StudyQuality& q) { return q.sd_deg; }},
        {"lost samples / %",
         [](const StudyQuality& q) { return std::optional<double>(100.0 * q.lost_share()); }}};
    return {{"data_quality", {page_mm, 52.0}, [&results](FigurePen& pen) {
                 const double wide = page_mm / static_cast<double>(std::size(panels));
                 const auto count = static_cast<double>(results.session_quality.size());
                 for (std::size_t p = 0; p < std::size(panels); ++p) {
                     double most = 0.0;
                     bool is_known = false;
                     for (const StudyQuality& quality : results.session_quality) {
                         const std::optional<double> value = panels[p].value(quality);
                         is_known = is_known || value;
                         most = std::max(most, value.value_or(0.0));
                     }
                     const ChartAxes axes(pen, {wide * static_cast<double>(p), 0.0}, {wide, 52.0},
                                          {0.5, count + 0.5, "session", false, true},
                                          {0.0, most > 0.0 ? 1.1 * most : 1.0, panels[p].label});
                     if (!is_known)
                         pen.text({0.5 * (axes.left() + axes.right()), 0.5 * (axes.top() + axes.floor())},
                                  "not recorded", title_points, TextAlign::centre, figure_grey);
                     for (std::size_t s = 0; s < results.session_quality.size(); ++s) {
                         if (const std::optional<double> value = panels[p].value(results.session_quality[s]))
                             pen.dot(axes.place(static_cast<double>(s + 1), *value), 0.9, figure_colour(0));
                     }
                 }
             }}};
}

} // namespace

std::vector<StudyFigure> study_figures(const StudyResults& results) {
    std::vector<StudyFigure> figures;
    for (const auto make : {area_share_figures, distribution_figures, pair_figures, time_course,
                            fixation_durations, main_sequence, data_quality}) {
        for (StudyFigure& figure : make(results))
            figures.push_back(std::move(figure));
    }
    return figures;
}

std::vector<std::string> write_figures(const StudyResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::vector<std::string> written;
    for (const StudyFigure& figure : study_figures(results)) {
        save_figure(folder, figure);
        written.push_back(figure.name);
    }
    return written;
}

} // namespace overt
