#include "app/cli/figures.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace overt {

BenchFigure at_most(std::string figure, double value, std::string unit, double bound) {
    return {std::move(figure), value, std::move(unit), fmt::format("<= {:.9g}", bound), value <= bound};
}

BenchFigure at_least(std::string figure, double value, std::string unit, double bound) {
    return {std::move(figure), value, std::move(unit), fmt::format(">= {:.9g}", bound), value >= bound};
}

bool all_hold(const BenchFigures& figures) {
    return std::ranges::none_of(figures, [](const BenchFigure& figure) { return figure.holds == false; });
}

nlohmann::ordered_json to_json(const BenchFigures& figures) {
    auto list = nlohmann::ordered_json::array();
    for (const BenchFigure& figure : figures) {
        nlohmann::ordered_json item{
            {"figure", figure.figure}, {"value", figure.value}, {"unit", figure.unit}};
        if (figure.holds) {
            item["target"] = figure.target;
            item["holds"] = *figure.holds;
        }
        list.push_back(std::move(item));
    }
    return {{"figures", list}};
}

void print_table(const BenchFigures& figures) {
    std::size_t width = 0;
    for (const BenchFigure& figure : figures)
        width = std::max(width, figure.figure.size());
    for (const BenchFigure& figure : figures) {
        fmt::print("{:<{}}  {:>12.5g} {:<10}", figure.figure, width, figure.value, figure.unit);
        if (figure.holds)
            fmt::print(" {:<12} {}", figure.target, *figure.holds ? "holds" : "MISSED");
        fmt::print("\n");
    }
}

} // namespace overt
