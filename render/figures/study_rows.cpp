#include "render/figures/study_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/figures/row_chart.h"

namespace overt {
namespace {

std::string number_text(const std::optional<double>& value) {
    if (!value)
        return "n/a";
    const double size = std::abs(*value);
    if (size >= 100.0 || size == 0.0)
        return fmt::format("{:.0f}", *value);
    if (size >= 0.01)
        return fmt::format("{:.3g}", *value);
    // Two digits, written out: densities are small, and powers of ten are hard to compare down a column.
    constexpr double least = 1e-6;
    if (size < least)
        return *value > 0.0 ? "< 0.000001" : "> -0.000001";
    const int decimals = 1 - static_cast<int>(std::floor(std::log10(size)));
    return fmt::format("{:.{}f}", *value, decimals);
}

std::string text_of(const Estimate& estimate) {
    if (!estimate.value)
        return "n/a";
    return estimate.interval
               ? fmt::format("{} [{}, {}]", number_text(estimate.value), number_text(estimate.interval->low),
                             number_text(estimate.interval->high))
               : number_text(estimate.value);
}

std::string interval_note(const StudyResults& results) {
    return fmt::format("In brackets, and as whiskers, {:g} % intervals over observers.",
                       100.0 * results.confidence);
}

/// What stands in a column; "all" where the keys do not name it.
std::string level_of(const std::vector<StudyKey>& keys, const std::string& column) {
    const auto found = std::ranges::find(keys, column, &StudyKey::column);
    return found == keys.end() ? "all" : found->value;
}

/// The columns that keys name, in the order in which they come.
template <class Rows, class KeysOf>
std::vector<std::string> columns_of(const Rows& rows, const KeysOf& keys_of) {
    std::vector<std::string> columns;
    for (const auto& row : rows) {
        for (const StudyKey& key : keys_of(row)) {
            if (std::ranges::find(columns, key.column) == columns.end())
                columns.push_back(key.column);
        }
    }
    return columns;
}

/// The number of a name among those before, which is new if it is not among them.
std::size_t number_among(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        names.push_back(name);
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

} // namespace

std::vector<StudyFigure> area_share_figures(const StudyResults& results) {
    std::vector<AreaRow> levels, groups;
    for (const AreaRow& row : results.area_rows) {
        if (row.area == results.area && row.by_count.value)
            (row.keys.size() == 1 ? levels : groups).push_back(row);
    }
    const bool has_levels = !levels.empty();
    const std::vector<AreaRow>& rows = has_levels ? levels : groups;
    RowChart chart;
    std::vector<std::string> factors;
    if (has_levels)
        chart.columns = {{"factor", true}, {"level", true}};
    else
        factors = columns_of(rows, [](const AreaRow& row) { return row.keys; });
    for (const std::string& factor : factors)
        chart.columns.push_back({factor, true});
    if (chart.columns.empty())
        chart.columns.push_back({"group", true});
    chart.bars_before = chart.columns.size();
    chart.bars_head =
        fmt::format("share of fixations on {}", results.area == head_area ? "the head" : results.area);
    chart.most = 1.0;
    chart.columns.push_back({"mean"});
    chart.columns.push_back({"observers"});
    chart.note = fmt::format("Points: single observers. {}", interval_note(results));
    std::vector<std::string> colours;
    for (const AreaRow& row : rows) {
        ChartRow shown;
        if (has_levels)
            shown.cells = {row.keys.front().column, row.keys.front().value};
        else if (factors.empty())
            shown.cells = {"all"};
        for (const std::string& factor : factors)
            shown.cells.push_back(level_of(row.keys, factor));
        shown.bar = {row.by_count.value, row.by_count.interval, row.of_observers,
                     number_among(colours, shown.cells.front())};
        shown.cells.push_back(text_of(row.by_count));
        shown.cells.push_back(fmt::format("{}", row.observers));
        chart.rows.push_back(std::move(shown));
    }
    return figures_of(chart, "figure_4");
}

std::vector<StudyFigure> distribution_figures(const StudyResults& results) {
    const auto keys_of = [&](const DistributionRow& row) {
        return results.groups[static_cast<std::size_t>(row.group)].keys;
    };
    const std::vector<std::string> factors = columns_of(results.distributions, keys_of);
    const bool with_object = std::ranges::find(factors, "object") == factors.end();
    RowChart chart;
    for (const std::string& factor : factors)
        chart.columns.push_back({factor, true});
    if (with_object)
        chart.columns.push_back({"object", true});
    chart.bars_before = chart.columns.size();
    chart.bars_head = "mean WSS / mm²";
    for (const char* head : {"mean WSS / mm²", "Var x / mm²", "Var y / mm²", "Var z / mm²",
                             "highest density / (ms/mm²)", "mean density / (ms/mm²)"})
        chart.columns.push_back({head});
    chart.note = fmt::format("Mean WSS is the sum of the variances along x, y and z. Densities are those of "
                             "the map by duration, for one trial. {}",
                             interval_note(results));
    std::vector<std::string> colours;
    for (const DistributionRow& row : results.distributions) {
        ChartRow shown;
        for (const std::string& factor : factors)
            shown.cells.push_back(level_of(keys_of(row), factor));
        if (with_object)
            shown.cells.push_back(results.objects[static_cast<std::size_t>(row.object)].id);
        shown.bar = {row.wss_mm2.value, row.wss_mm2.interval, {}, number_among(colours, shown.cells.front())};
        shown.cells.push_back(text_of(row.wss_mm2));
        for (const std::optional<double>& variance : row.variance_mm2)
            shown.cells.push_back(number_text(variance));
        shown.cells.push_back(number_text(row.map_peak));
        shown.cells.push_back(number_text(row.map_mean));
        chart.rows.push_back(std::move(shown));
    }
    return figures_of(chart, "figure_5");
}

std::vector<StudyFigure> pair_figures(const StudyResults& results) {
    const std::vector<std::string> factors =
        columns_of(results.pairs, [](const PairRow& row) { return row.keys; });
    RowChart chart;
    for (const std::string& factor : factors)
        chart.columns.push_back({factor, true});
    chart.columns.insert(chart.columns.end(), {{"a", true},
                                               {"b", true},
                                               {"WSS a − b / deg²"},
                                               {"p of WSS (Holm)"},
                                               {"CC of all maps"},
                                               {"its p (Holm)"},
                                               {"CC"},
                                               {"SIM"}});
    chart.note =
        fmt::format("CC of all maps: of the maps of all observers. WSS, CC and SIM: of one observer and one "
                    "object, then averaged; in brackets {:g} % intervals over observers. p after "
                    "Holm, where it could be reckoned.",
                    100.0 * results.confidence);
    for (const PairRow& row : results.pairs) {
        ChartRow shown;
        for (const std::string& factor : factors)
            shown.cells.push_back(level_of(row.keys, factor));
        shown.cells.insert(shown.cells.end(), {row.a, row.b, text_of(row.wss_difference_deg2),
                                               number_text(row.wss_p_holm ? row.wss_p_holm : row.wss_p),
                                               number_text(row.maps_cc),
                                               number_text(row.maps_p_holm ? row.maps_p_holm : row.maps_p),
                                               text_of(row.cc.value), text_of(row.sim_mit.value)});
        chart.rows.push_back(std::move(shown));
    }
    return figures_of(chart, "table_1");
}

} // namespace overt
