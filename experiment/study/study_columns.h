/// What columns of a study's tables are made from.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/study_results.h"

namespace overt {

template <class Row> using StudyColumns = std::vector<typename RowLayout<Row>::Column>;

/// A number that may be missing.
template <class Row, class Value>
StudyColumns<Row> number_column(std::string name, std::string meaning, std::string unit, int decimals,
                                Value value) {
    return {{{std::move(name), std::move(meaning), std::move(unit), {}},
             [value, decimals](TableCells& to, const Row& row) {
                 const std::optional<double> number = value(row);
                 number ? to.fixed(*number, decimals) : to.missing();
             }}};
}

template <class Row, class Value>
StudyColumns<Row> count_column(std::string name, std::string meaning, Value value) {
    return {{{std::move(name), std::move(meaning), "", {}},
             [value](TableCells& to, const Row& row) { to.integer(value(row)); }}};
}

template <class Row, class Value>
StudyColumns<Row> text_column(std::string name, std::string meaning, Value value) {
    return {{{std::move(name), std::move(meaning), "", {}}, [value](TableCells& to, const Row& row) {
                 // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): some values are views
                 const std::string text{value(row)};
                 text.empty() || text == "n/a" ? to.missing() : to.text(text);
             }}};
}

/// The value, both ends of its interval, and why there is none.
template <class Row, class Of>
StudyColumns<Row> estimate_columns(const std::string& name, const std::string& meaning,
                                   const std::string& unit, int decimals, Of of) {
    const auto part = [decimals, of](auto value) {
        return [decimals, of, value](TableCells& to, const Row& row) {
            const std::optional<double> number = value(of(row));
            number ? to.fixed(*number, decimals) : to.missing();
        };
    };
    return {{{name, meaning, unit, {}}, part([](const Estimate& estimate) { return estimate.value; })},
            {{name + "_low", "Lower end of the interval of confidence of " + name, unit, {}},
             part([](const Estimate& estimate) {
                 return estimate.interval ? std::optional(estimate.interval->low) : std::nullopt;
             })},
            {{name + "_high", "Upper end of the interval of confidence of " + name, unit, {}},
             part([](const Estimate& estimate) {
                 return estimate.interval ? std::optional(estimate.interval->high) : std::nullopt;
             })},
            {{name + "_absent", "Why there is no " + name + "; n/a: there is one", "", {}},
             [of](TableCells& to, const Row& row) {
                 const std::string& absent = of(row).absent;
                 absent.empty() ? to.missing() : to.text(absent);
             }}};
}

/// A column for each column of the groups; what a row leaves open is "all".
template <class Row, class Keys>
StudyColumns<Row> key_columns(const std::vector<std::string>& by, Keys keys) {
    StudyColumns<Row> columns;
    for (const std::string& column : by) {
        columns.push_back({{column, "The group's " + column + "; all: any", "", {}},
                           [column, keys](TableCells& to, const Row& row) {
                               for (const StudyKey& key : keys(row)) {
                                   if (key.column == column) {
                                       key.value == "n/a" ? to.missing() : to.text(key.value);
                                       return;
                                   }
                               }
                               to.text("all");
                           }});
    }
    return columns;
}

template <class Row> void add_columns(StudyColumns<Row>& to, StudyColumns<Row> more) {
    for (auto& column : more)
        to.push_back(std::move(column));
}

/// All of them in a row.
template <class Row, class... More> StudyColumns<Row> joined_columns(StudyColumns<Row> first, More... more) {
    (add_columns<Row>(first, std::move(more)), ...);
    return first;
}

} // namespace overt
