/// A table for a paper, with one column of bars if it is asked for: each number has a head that says what it
/// is, each condition a column for each of its factors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/statistics/estimate.h"
#include "render/figures/pen.h"

namespace overt {

struct ChartColumn {
    std::string head; ///< with its unit
    bool is_text = false;
};

/// From 0 to its value, with its interval and the values of single observers.
struct RowBar {
    std::optional<double> value;
    std::optional<Interval> interval;
    std::vector<double> dots{};
    std::size_t colour = 0; ///< a figure_colour
};

struct ChartRow {
    std::vector<std::string> cells; ///< one for each column
    RowBar bar{};
};

struct RowChart {
    std::vector<ChartColumn> columns;
    std::vector<ChartRow> rows;
    /// Column before which the bars stand; nothing: no bars.
    std::optional<std::size_t> bars_before;
    std::string bars_head;
    double least = 0.0;              ///< of the bars' axis at the most
    std::optional<double> most = {}; ///< of the bars' axis at the least; nothing: as the rows have it
    std::string note{};              ///< below the rows
};

/// As wide as a column of a journal where everything fits into one, or as a page; wider only where a page
/// cannot hold the columns. Rows that are more than a page holds go on in figures called `name`_2, `name`_3 …
/// No text is cut: what is longer than its column is broken into lines. Rows with the same text in their
/// first column and one below the other show it once.
std::vector<StudyFigure> figures_of(const RowChart& chart, const std::string& name);

} // namespace overt
