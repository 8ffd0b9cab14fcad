#include "render/figures/study_figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/figures/axes.h"

namespace overt {
namespace {

std::string values_of(const std::vector<StudyKey>& keys) {
    std::string words;
    for (const StudyKey& key : keys)
        words += fmt::format("{}{}", words.empty() ? "" : ", ", key.value);
    return words.empty() ? "all" : words;
}

std::string number_text(const std::optional<double>& value) {
    if (!value)
        return "n/a";
    const double size = std::abs(*value);
    return size >= 100.0                 ? fmt::format("{:.0f}", *value)
           : size >= 0.01 || size == 0.0 ? fmt::format("{:.3g}", *value)
                                         : fmt::format("{:.1e}", *value);
}

std::string text_of(const Estimate& estimate) {
    if (!estimate.value)
        return "n/a";
    return estimate.interval
               ? fmt::format("{} [{}, {}]", number_text(estimate.value), number_text(estimate.interval->low),
                             number_text(estimate.interval->high))
               : number_text(estimate.value);
}

void whisker(FigurePen& pen, double x, double low, double high) {
    pen.line({x, low}, {x, high}, figure_ink, 0.25);
    pen.line({x - 0.7, low}, {x + 0.7, low}, figure_ink, 0.25);
    pen.line({x - 0.7, high}, {x + 0.7, high}, figure_ink, 0.25);
}

// Levels of one factor each, as bars with their intervals.
bool head_fractions(const StudyResults& results, const std::filesystem::path& folder) {
    std::vector<const HeadFractionRow*> rows;
    for (const HeadFractionRow& row : results.head_fractions) {
        if (row.keys.size() == 1 && row.by_count.value)
            rows.push_back(&row);
    }
    if (rows.empty()) {
        for (const HeadFractionRow& row : results.head_fractions) {
            if (row.by_count.value)
                rows.push_back(&row);
        }
    }
    if (rows.empty())
        return false;
    const double width = rows.size() > 7 ? page_mm : column_mm;
    save_figure(folder, "figure_4", {width, 68.0}, [&](FigurePen& pen) {
        std::vector<double> places;
        double at = 0.6;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (i > 0 && rows[i]->keys.front().column != rows[i - 1]->keys.front().column)
                at += 0.7;
            places.push_back(at++);
        }
        const ChartAxes axes(pen, {0.0, 0.0}, {width, 58.0}, {0.0, at, "", false},
                             {0.0, 1.0, "share of fixations on the head", false});
        const double half = 0.38 * (axes.across(1.0) - axes.across(0.0));
        std::string column;
        std::size_t factor = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const HeadFractionRow& row = *rows[i];
            const double x = axes.across(places[i]), y = axes.up(*row.by_count.value);
            if (row.keys.front().column != column) {
                factor += column.empty() ? 0 : 1;
                column = row.keys.front().column;
                pen.text({x - half, 66.0}, column, 7.5);
            }
            pen.box({x - half, y}, {2.0 * half, axes.floor() - y}, figure_colour(factor));
            // Each observer is a point, side by side in their order.
            const auto observers = static_cast<double>(row.of_observers.size());
            for (std::size_t o = 0; o < row.of_observers.size(); ++o)
                pen.dot({x + half * 1.6 * ((static_cast<double>(o) + 0.5) / observers - 0.5),
                         axes.up(row.of_observers[o])},
                        0.45, figure_ink, 0.55);
            if (row.by_count.interval)
                whisker(pen, x, axes.up(std::max(0.0, row.by_count.interval->low)),
                        axes.up(std::min(1.0, row.by_count.interval->high)));
            pen.text({x, axes.floor() + 3.8 + (rows.size() > 5 ? 3.2 * static_cast<double>(i % 2) : 0.0)},
                     values_of(row.keys), 6.0, TextAlign::centre);
        }
    });
    return true;
}

// The paper's boxes: mean WSS large, peak and mean of the map in the middle, variances at the right.
bool distribution_boxes(const StudyResults& results, const std::filesystem::path& folder) {
    if (results.distributions.empty())
        return false;
    // A line for each value of the first column, a box for each combination of the others.
    std::vector<std::string> lines, columns;
    const auto place_of = [](std::vector<std::string>& names, const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end())
            return static_cast<std::size_t>(found - names.begin());
        names.push_back(name);
        return names.size() - 1;
    };
    struct Box {
        std::size_t line, column;
        const DistributionRow* row;
    };
    std::vector<Box> boxes;
    double most = 0.0;
    for (const DistributionRow& row : results.distributions) {
        const std::vector<StudyKey>& keys = results.groups[static_cast<std::size_t>(row.group)].keys;
        std::string rest;
        bool has_sculpture = false;
        for (std::size_t k = 1; k < keys.size(); ++k) {
            rest += fmt::format("{}{}", rest.empty() ? "" : ", ", keys[k].value);
            has_sculpture = has_sculpture || keys[k].column == "sculpture";
        }
        if (!has_sculpture)
            rest = fmt::format("{}{}{}", results.sculptures[static_cast<std::size_t>(row.sculpture)].id,
                               rest.empty() ? "" : ", ", rest);
        const std::size_t line = place_of(lines, keys.empty() ? "all" : keys.front().value);
        boxes.push_back({line, place_of(columns, rest), &row});
        most = std::max(most, row.wss_mm2.value.value_or(0.0));
    }
    const double left = 20.0, wide = (page_mm - left - 1.0) / static_cast<double>(columns.size()),
                 high = 10.5;
    const glm::dvec2 size(page_mm, 8.0 + high * static_cast<double>(lines.size()) + 7.0);
    save_figure(folder, "figure_5", size, [&](FigurePen& pen) {
        // Letters as large as the boxes let them be.
        const double points = std::clamp(wide / 3.4, 3.2, 7.0);
        for (std::size_t i = 0; i < columns.size(); ++i)
            pen.text({left + wide * (static_cast<double>(i) + 0.5), 4.5 + 2.4 * static_cast<double>(i % 2)},
                     columns[i], std::min(6.0, 1.2 * points), TextAlign::centre);
        for (std::size_t i = 0; i < lines.size(); ++i)
            pen.text({1.0, 8.0 + high * (static_cast<double>(i) + 0.6)}, lines[i], 6.5);
        for (const Box& box : boxes) {
            const DistributionRow& row = *box.row;
            const glm::dvec2 corner(left + wide * static_cast<double>(box.column),
                                    8.0 + high * static_cast<double>(box.line));
            const double share = most > 0.0 ? row.wss_mm2.value.value_or(0.0) / most : 0.0;
            pen.box(corner + 0.2, {wide - 0.4, high - 0.4}, {0.95, 0.96, 0.97});
            pen.box({corner.x + 0.2, corner.y + 0.2 + (1.0 - share) * (high - 0.4)},
                    {wide - 0.4, share * (high - 0.4)}, {0.82, 0.88, 0.95});
            pen.text(corner + glm::dvec2(0.8, 6.2), number_text(row.wss_mm2.value), 1.1 * points);
            pen.text(corner + glm::dvec2(0.66 * wide, 3.4), number_text(row.map_peak), points,
                     TextAlign::right);
            pen.text(corner + glm::dvec2(0.66 * wide, 9.4), number_text(row.map_mean), points,
                     TextAlign::right);
            for (std::size_t axis = 0; axis < 3; ++axis)
                pen.text(corner + glm::dvec2(wide - 0.7, 3.4 + 3.0 * static_cast<double>(axis)),
                         number_text(row.variance_mm2[axis]), points, TextAlign::right);
        }
        pen.text({1.0, size.y - 2.0},
                 "Left: mean WSS / mm², also the height of the shade. Middle: highest and mean density / "
                 "(ms/mm²). Right: "
                 "variance of x, y, z / mm².",
                 6.0, TextAlign::left, figure_grey);
    });
    return true;
}

bool pair_table(const StudyResults& results, const std::filesystem::path& folder) {
    if (results.pairs.empty())
        return false;
    const double height = 12.0 + 6.0 * static_cast<double>(results.pairs.size());
    save_figure(folder, "table_1", {page_mm, height}, [&](FigurePen& pen) {
        const std::array<double, 7> at{1.0, 62.0, 88.0, 104.0, 124.0, 138.0, 160.0};
        const std::array<const char*, 7> heads{
            "pair a, b", "WSS a − b / deg²", "p (Holm)", "CC of maps", "p (Holm)", "CC", "SIM"};
        for (std::size_t i = 0; i < at.size(); ++i)
            pen.text({at[i], 5.0}, heads[i], 6.5);
        pen.line({1.0, 6.6}, {page_mm - 1.0, 6.6}, figure_ink, 0.3);
        double y = 11.0;
        for (const PairRow& row : results.pairs) {
            const std::array<std::string, 7> cells{
                fmt::format("{}{}{}, {}", values_of(row.keys) == "all" ? "" : values_of(row.keys),
                            row.keys.empty() ? "" : ": ", row.a, row.b),
                text_of(row.wss_difference_deg2),
                number_text(row.wss_p_holm ? row.wss_p_holm : row.wss_p),
                number_text(row.maps_cc),
                number_text(row.maps_p_holm ? row.maps_p_holm : row.maps_p),
                text_of(row.cc.value),
                text_of(row.sim_mit.value)};
            for (std::size_t i = 0; i < cells.size(); ++i)
                pen.text({at[i], y}, cells[i], 5.6);
            y += 6.0;
        }
        pen.line({1.0, y - 3.0}, {page_mm - 1.0, y - 3.0}, figure_ink, 0.3);
    });
    return true;
}

bool time_course(const StudyResults& results, const std::filesystem::path& folder) {
    double end = 0.0;
    std::vector<std::string> levels;
    for (const TimeCourseRow& row : results.time_course) {
        if (!row.head_fraction.value)
            continue;
        end = std::max(end, row.to_s);
        if (std::find(levels.begin(), levels.end(), row.key.value) == levels.end())
            levels.push_back(row.key.value);
    }
    if (levels.empty())
        return false;
    save_figure(folder, "time_course", {column_mm, 72.0}, [&](FigurePen& pen) {
        const ChartAxes axes(pen, {0.0, 8.0}, {column_mm, 64.0}, {0.0, end, "time since onset / s", false},
                             {0.0, 1.0, "share of fixation time on the head", false});
        for (std::size_t level = 0; level < levels.size(); ++level) {
            std::vector<glm::dvec2> points;
            for (const TimeCourseRow& row : results.time_course) {
                if (row.key.value != levels[level] || !row.head_fraction.value)
                    continue;
                const double x =
                    axes.across(0.5 * (row.from_s + row.to_s)) +
                    0.6 * (static_cast<double>(level) - 0.5 * static_cast<double>(levels.size() - 1));
                points.emplace_back(x, axes.up(*row.head_fraction.value));
                if (row.head_fraction.interval)
                    pen.line({x, axes.up(std::max(0.0, row.head_fraction.interval->low))},
                             {x, axes.up(std::min(1.0, row.head_fraction.interval->high))},
                             figure_colour(level), 0.2);
            }
            pen.path(points, figure_colour(level), 0.4);
            for (const glm::dvec2& point : points)
                pen.dot(point, 0.6, figure_colour(level));
            const std::size_t column = level % 3, line = level / 3;
            const double x = 13.0 + 24.0 * static_cast<double>(column),
                         y = 3.5 + 3.4 * static_cast<double>(line);
            pen.box({x, y - 1.9}, {2.2, 2.2}, figure_colour(level));
            pen.text({x + 3.0, y}, levels[level], 6.5);
        }
    });
    return true;
}

bool fixation_durations(const StudyResults& results, const std::filesystem::path& folder) {
    constexpr double bin_ms = 25.0;
    constexpr std::size_t bins = 40;
    std::vector<double> counts(bins, 0.0), durations;
    for (const StudyFixation& fixation : results.fixations) {
        if (!fixation.counted())
            continue;
        durations.push_back(1000.0 * fixation.duration_s);
        counts[std::min(bins - 1, static_cast<std::size_t>(durations.back() / bin_ms))] += 1.0;
    }
    if (durations.empty())
        return false;
    std::nth_element(durations.begin(), durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2),
                     durations.end());
    save_figure(folder, "fixation_durations", {column_mm, 60.0}, [&](FigurePen& pen) {
        const ChartAxes axes(
            pen, {0.0, 0.0}, {column_mm, 60.0},
            {0.0, bin_ms * bins, "fixation duration / ms (last bar: and longer)", false},
            {0.0, 1.05 * *std::max_element(counts.begin(), counts.end()), "fixations", false});
        for (std::size_t i = 0; i < bins; ++i) {
            const double x = axes.across(bin_ms * static_cast<double>(i));
            pen.box({x + 0.1, axes.up(counts[i])},
                    {axes.across(bin_ms) - axes.across(0.0) - 0.2, axes.floor() - axes.up(counts[i])},
                    figure_colour(0));
        }
        pen.text({axes.right(), 6.0},
                 fmt::format("median {:.0f} ms, n = {}", durations[durations.size() / 2], durations.size()),
                 6.5, TextAlign::right);
    });
    return true;
}

// Amplitude and highest velocity of saccades, as the thinned traces have them.
bool main_sequence(const StudyResults& results, const std::filesystem::path& folder) {
    std::vector<glm::dvec2> saccades;
    for (const StudyTrace& trace : results.traces) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(trace.trial)];
        const ScreenGeometry& screen = results.sculptures[static_cast<std::size_t>(trial.sculpture)].screen;
        for (const StudyTraceEvent& event : trace.events) {
            if (event.kind != GazeEvent::Kind::saccade)
                continue;
            const auto first = std::lower_bound(
                trace.points.begin(), trace.points.end(), event.onset_s - 0.004,
                [](const StudyTracePoint& point, double time) { return point.time_s < time; });
            const StudyTracePoint *before = nullptr, *begin = nullptr;
            double fastest = 0.0;
            bool is_whole = true;
            for (auto point = first;
                 point != trace.points.end() && point->time_s <= event.onset_s + event.duration_s + 0.004;
                 ++point) {
                is_whole = is_whole && point->gaze;
                if (!is_whole)
                    break;
                if (before && point->time_s > before->time_s)
                    fastest = std::max(fastest, screen.angle_between(*before->gaze, *point->gaze).value /
                                                    (point->time_s - before->time_s));
                begin = begin ? begin : &*point;
                before = &*point;
            }
            if (!is_whole || !begin)
                continue;
            const double amplitude = screen.angle_between(*begin->gaze, *before->gaze).value;
            if (amplitude >= 0.1 && amplitude <= 40.0 && fastest >= 5.0 && fastest <= 1500.0)
                saccades.emplace_back(amplitude, fastest);
        }
    }
    if (saccades.empty())
        return false;
    // A cloud of some thousands shows what there is.
    const std::size_t every = 1 + saccades.size() / 4000;
    save_figure(folder, "main_sequence", {column_mm, 70.0}, [&](FigurePen& pen) {
        const ChartAxes axes(pen, {0.0, 0.0}, {column_mm, 70.0}, {0.1, 40.0, "saccade amplitude / deg", true},
                             {5.0, 1500.0, "highest velocity / (deg/s)", true});
        for (std::size_t i = 0; i < saccades.size(); i += every)
            pen.dot(axes.place(saccades[i].x, saccades[i].y), 0.35, figure_colour(5), 0.4);
    });
    return true;
}

bool data_quality(const StudyResults& results, const std::filesystem::path& folder) {
    if (results.session_quality.empty())
        return false;
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
    save_figure(folder, "data_quality", {page_mm, 52.0}, [&](FigurePen& pen) {
        const double wide = page_mm / static_cast<double>(std::size(panels));
        const auto count = static_cast<double>(results.session_quality.size());
        for (std::size_t p = 0; p < std::size(panels); ++p) {
            double most = 0.0;
            for (const StudyQuality& quality : results.session_quality)
                most = std::max(most, panels[p].value(quality).value_or(0.0));
            const ChartAxes axes(pen, {wide * static_cast<double>(p), 0.0}, {wide, 52.0},
                                 {0.5, count + 0.5, "session", false},
                                 {0.0, most > 0.0 ? 1.1 * most : 1.0, panels[p].label, false});
            for (std::size_t s = 0; s < results.session_quality.size(); ++s) {
                if (const std::optional<double> value = panels[p].value(results.session_quality[s]))
                    pen.dot(axes.place(static_cast<double>(s + 1), *value), 0.9, figure_colour(0));
            }
        }
    });
    return true;
}

} // namespace

std::vector<std::string> write_figures(const StudyResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    struct Figure {
        const char* name;
        bool (*write)(const StudyResults&, const std::filesystem::path&);
    };
    static constexpr Figure figures[] = {{"figure_4", &head_fractions},
                                         {"figure_5", &distribution_boxes},
                                         {"table_1", &pair_table},
                                         {"time_course", &time_course},
                                         {"fixation_durations", &fixation_durations},
                                         {"main_sequence", &main_sequence},
                                         {"data_quality", &data_quality}};
    std::vector<std::string> written;
    for (const Figure& figure : figures) {
        if (figure.write(results, folder))
            written.emplace_back(figure.name);
    }
    return written;
}

} // namespace overt
