#include "render/figures/row_chart.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "render/figures/axes.h"

namespace overt {
namespace {

constexpr double margin_mm = 1.0, gap_mm = 2.5, row_gap_mm = 1.0, least_row_mm = 4.0, least_bars_mm = 34.0,
                 page_rows_mm = 225.0, note_points = 6.0;
constexpr FigureColour faint{0.88, 0.90, 0.92};

using Lines = std::vector<std::string>;

double widest_of(const Lines& lines, double points) {
    double widest = 0.0;
    for (const std::string& line : lines)
        widest = std::max(widest, extent_of(line, points).width);
    return widest;
}

Lines words_of(const std::string& text) {
    Lines words;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        if (end > begin)
            words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// What a column needs: `least` without breaking words, but no more than `broken_mm` for text, which may be
/// broken anywhere; `natural` with each cell on one line.
struct ColumnNeed {
    double least = 0.0, natural = 0.0;
};

ColumnNeed need_of(const RowChart& chart, std::size_t column, double points) {
    constexpr double broken_mm = 20.0, rounding_mm = 0.05;
    ColumnNeed need{widest_of(words_of(chart.columns[column].head), points), 0.0};
    need.natural = need.least;
    for (const ChartRow& row : chart.rows) {
        need.natural = std::max(need.natural, extent_of(row.cells[column], points).width);
        need.least = std::max(need.least, widest_of(words_of(row.cells[column]), points));
    }
    if (chart.columns[column].is_text)
        need.least = std::min(need.least, broken_mm);
    return {need.least + rounding_mm, std::max(need.least, need.natural) + rounding_mm};
}

/// Where the columns stand, and how large the letters are.
struct RowLayout {
    double width_mm = page_mm, points = 6.5;
    std::vector<double> left, width; ///< by column
    double bars_left = 0.0, bars_width = 0.0;
};

/// Widths between what is least and what is natural that fill `room_mm` together: those that need little get
/// it, the others the same.
std::vector<double> shared_out(const std::vector<ColumnNeed>& needs, double room_mm) {
    const auto with_cap = [&](double cap) {
        std::vector<double> widths;
        for (const ColumnNeed& need : needs)
            widths.push_back(std::clamp(cap, need.least, need.natural));
        return widths;
    };
    double low = 0.0, high = 2000.0;
    for (int i = 0; i < 50; ++i) {
        const double cap = 0.5 * (low + high);
        const std::vector<double> widths = with_cap(cap);
        (std::accumulate(widths.begin(), widths.end(), 0.0) > room_mm ? high : low) = cap;
    }
    return with_cap(low);
}

RowLayout layout_of_columns(const RowChart& chart) {
    const std::size_t parts = chart.columns.size() + (chart.bars_before ? 1 : 0);
    const double fixed =
        2.0 * margin_mm + gap_mm * static_cast<double>(parts - 1) + (chart.bars_before ? least_bars_mm : 0.0);
    RowLayout layout;
    std::vector<ColumnNeed> needs;
    double least = 0.0, natural = 0.0;
    for (const double points : {6.5, 5.8, 5.2}) {
        layout.points = points;
        needs.clear();
        least = natural = fixed;
        for (std::size_t i = 0; i < chart.columns.size(); ++i) {
            needs.push_back(need_of(chart, i, points));
            least += needs.back().least;
            natural += needs.back().natural;
        }
        if (least <= page_mm)
            break;
    }
    layout.width_mm = natural <= column_mm ? column_mm : std::max(page_mm, least);
    layout.width = shared_out(needs, layout.width_mm - fixed);
    const double taken = std::accumulate(layout.width.begin(), layout.width.end(), fixed);
    if (chart.bars_before)
        layout.bars_width = least_bars_mm + std::max(0.0, layout.width_mm - taken);
    // Room that is left over goes to the bars, or between the columns.
    const double gap = gap_mm + (chart.bars_before || parts < 2 ? 0.0
                                                                : std::max(0.0, layout.width_mm - taken) /
                                                                      static_cast<double>(parts - 1));
    double at = margin_mm;
    for (std::size_t i = 0; i < chart.columns.size(); ++i) {
        if (chart.bars_before == i) {
            layout.bars_left = at;
            at += layout.bars_width + gap;
        }
        layout.left.push_back(at);
        at += layout.width[i] + gap;
    }
    if (chart.bars_before && *chart.bars_before >= chart.columns.size())
        layout.bars_left = at;
    return layout;
}

/// The axis of the bars: all that is drawn along it lies within.
class BarsAxis {
  public:
    BarsAxis(const RowChart& chart, const RowLayout& layout) : range_{chart.least, 0.0, chart.bars_head} {
        double high = 0.0;
        for (const ChartRow& row : chart.rows) {
            const RowBar& bar = row.bar;
            std::vector<double> values = bar.dots;
            if (bar.value)
                values.push_back(*bar.value);
            if (bar.interval)
                values.insert(values.end(), {bar.interval->low, bar.interval->high});
            for (const double value : values) {
                range_.low = std::min(range_.low, value);
                high = std::max(high, value);
            }
        }
        range_.high = std::max(chart.most.value_or(0.0), high);
        if (!(range_.high > range_.low))
            range_.high = range_.low + 1.0;
        ticks_ = ticks_that_fit(range_, 0.8 * layout.bars_width, false);
        double inset = 1.2;
        for (const double tick : ticks_)
            inset = std::max(inset, 0.5 * extent_of(tick_text(tick), tick_points).width);
        left_ = layout.bars_left + inset;
        length_ = layout.bars_width - 2.0 * inset;
    }
    double across(double value) const {
        return left_ + (value - range_.low) / (range_.high - range_.low) * length_;
    }
    const std::vector<double>& ticks() const { return ticks_; }

  private:
    AxisRange range_;
    std::vector<double> ticks_;
    double left_ = 0.0, length_ = 0.0;
};

void draw_bar(FigurePen& pen, const RowBar& bar, const BarsAxis& axis, double middle, double half) {
    if (bar.value) {
        const double from = axis.across(std::min(0.0, *bar.value)),
                     to = axis.across(std::max(0.0, *bar.value));
        pen.box({from, middle - half}, {to - from, 2.0 * half}, figure_colour(bar.colour));
    }
    // Each observer is a point, one below the other in their order.
    const auto count = static_cast<double>(bar.dots.size());
    for (std::size_t i = 0; i < bar.dots.size(); ++i)
        pen.dot(
            {axis.across(bar.dots[i]), middle + half * 1.6 * ((static_cast<double>(i) + 0.5) / count - 0.5)},
            0.4, figure_ink, 0.55);
    if (bar.interval) {
        const double low = axis.across(bar.interval->low), high = axis.across(bar.interval->high);
        pen.line({low, middle}, {high, middle}, figure_ink, 0.25);
        for (const double end : {low, high})
            pen.line({end, middle - 0.7}, {end, middle + 0.7}, figure_ink, 0.25);
    }
}

/// A row's cells in lines, and its height.
struct BrokenRow {
    std::vector<Lines> cells;
    double height = 0.0;
};

class RowPages {
  public:
    explicit RowPages(const RowChart& chart)
        : chart_(chart), layout_(layout_of_columns(chart_)), axis_(chart_, layout_) {
        Lines heads;
        for (const ChartColumn& column : chart_.columns)
            heads.push_back(column.head);
        head_ = broken(heads, 0.0);
        if (chart_.bars_before) {
            bars_head_ = broken_into_lines(chart_.bars_head, layout_.points, layout_.bars_width);
            head_.height = std::max(head_.height, height_of(bars_head_, layout_.points) + row_gap_mm);
        }
        for (const ChartRow& row : chart_.rows)
            rows_.push_back(broken(row.cells, least_row_mm));
        if (!chart_.note.empty())
            note_ = broken_into_lines(chart_.note, note_points, layout_.width_mm - 2.0 * margin_mm);
    }

    /// Ranges of rows, page by page.
    std::vector<std::pair<std::size_t, std::size_t>> pages() const {
        std::vector<std::pair<std::size_t, std::size_t>> pages;
        double height = 0.0;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (pages.empty() || height + rows_[i].height > page_rows_mm) {
                pages.emplace_back(i, i);
                height = 0.0;
            }
            height += rows_[i].height;
            pages.back().second = i + 1;
        }
        return pages;
    }

    glm::dvec2 size_mm(std::size_t begin, std::size_t end) const {
        double height = margin_mm + head_.height + axis_height() + 2.0 * margin_mm;
        for (std::size_t i = begin; i < end; ++i)
            height += rows_[i].height;
        if (!note_.empty())
            height += height_of(note_, note_points) + margin_mm;
        return {layout_.width_mm, height};
    }

    void draw(FigurePen& pen, std::size_t begin, std::size_t end) const {
        const double right = layout_.width_mm - margin_mm;
        double y = margin_mm;
        draw_head(pen, y);
        y += head_.height;
        pen.line({margin_mm, y}, {right, y}, figure_ink, 0.3);
        const double top = y;
        double floor = y;
        for (std::size_t i = begin; i < end; ++i)
            floor += rows_[i].height;
        if (chart_.bars_before) {
            for (const double tick : axis_.ticks())
                pen.line({axis_.across(tick), top}, {axis_.across(tick), floor}, faint, 0.2);
        }
        for (std::size_t i = begin; i < end; ++i) {
            const bool is_another = i == begin || chart_.rows[i].cells[0] != chart_.rows[i - 1].cells[0];
            if (is_another && i > begin)
                pen.line({margin_mm, y}, {right, y}, faint, 0.2);
            draw_row(pen, i, y, is_another);
            y += rows_[i].height;
        }
        pen.line({margin_mm, y}, {right, y}, figure_ink, 0.3);
        if (chart_.bars_before) {
            for (const double tick : axis_.ticks()) {
                const TextExtent extent = extent_of(tick_text(tick), tick_points);
                pen.line({axis_.across(tick), y}, {axis_.across(tick), y + 0.8});
                pen.text({axis_.across(tick), y + 1.2 + extent.above}, tick_text(tick), tick_points,
                         TextAlign::centre);
            }
        }
        draw_lines(pen, {margin_mm, y + axis_height() + margin_mm}, note_, note_points, TextAlign::left,
                   figure_grey);
    }

  private:
    double axis_height() const {
        return chart_.bars_before ? 1.2 + extent_of("0", tick_points).height() : 0.0;
    }

    BrokenRow broken(const Lines& cells, double least_mm) const {
        BrokenRow row;
        double highest = 0.0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            row.cells.push_back(broken_into_lines(cells[i], layout_.points, layout_.width[i]));
            highest = std::max(highest, height_of(row.cells.back(), layout_.points));
        }
        row.height = std::max(least_mm, highest + row_gap_mm);
        return row;
    }

    void draw_cell(FigurePen& pen, std::size_t column, double top, const Lines& lines) const {
        const bool is_text = chart_.columns[column].is_text;
        draw_lines(pen, {layout_.left[column] + (is_text ? 0.0 : layout_.width[column]), top}, lines,
                   layout_.points, is_text ? TextAlign::left : TextAlign::right);
    }

    void draw_head(FigurePen& pen, double y) const {
        const double floor = y + head_.height - 0.5 * row_gap_mm;
        for (std::size_t i = 0; i < head_.cells.size(); ++i)
            draw_cell(pen, i, floor - height_of(head_.cells[i], layout_.points), head_.cells[i]);
        draw_lines(pen, {layout_.bars_left, floor - height_of(bars_head_, layout_.points)}, bars_head_,
                   layout_.points);
    }

    void draw_row(FigurePen& pen, std::size_t number, double y, bool with_first) const {
        const BrokenRow& row = rows_[number];
        for (std::size_t i = with_first ? 0 : 1; i < row.cells.size(); ++i)
            draw_cell(pen, i, y + 0.5 * (row.height - height_of(row.cells[i], layout_.points)), row.cells[i]);
        if (chart_.bars_before)
            draw_bar(pen, chart_.rows[number].bar, axis_, y + 0.5 * row.height, 0.38 * least_row_mm);
    }

    RowChart chart_;
    RowLayout layout_;
    BarsAxis axis_;
    BrokenRow head_;
    Lines bars_head_, note_;
    std::vector<BrokenRow> rows_;
};

} // namespace

std::vector<StudyFigure> figures_of(const RowChart& chart, const std::string& name) {
    const auto pages = std::make_shared<const RowPages>(chart);
    std::vector<StudyFigure> figures;
    for (const auto& [begin, end] : pages->pages()) {
        figures.push_back({figures.empty() ? name : fmt::format("{}_{}", name, figures.size() + 1),
                           pages->size_mm(begin, end), [pages, begin = begin, end = end](FigurePen& pen) {
                               pages->draw(pen, begin, end);
                           }});
    }
    return figures;
}

} // namespace overt
