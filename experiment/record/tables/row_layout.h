/// A table by its columns: each stands in one place with its name, its meaning, its unit and what writes its
/// cell, so that the names, the dictionary and the cells cannot come apart.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiment/record/tables/table_writer.h"

namespace overt {

/// A value where there is one.
template <class Value> std::optional<Value> when(bool is_there, Value value) {
    return is_there ? std::optional<Value>(std::move(value)) : std::nullopt;
}

/// A member of something, or what a function makes of it; nothing where an optional or a pointer is empty.
template <class Maybe, class Of> auto of_maybe(const Maybe& maybe, Of of) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Of, decltype(*maybe)>>;
    return maybe ? std::optional<Value>(std::invoke(of, *maybe)) : std::nullopt;
}

template <class Row> class RowLayout {
  public:
    struct Column {
        TableColumn what;
        std::function<void(TableCells&, const Row&)> cell; ///< writes one cell
        /// A protocol has given it its name. Where the table has such a column of its own, be it before or
        /// behind, this one is called own_NAME: no two have one name.
        bool is_named = false;

        /// `of` gives a row's value (TableCells::put), or takes the cells and the row and writes one.
        template <class Of> Column(TableColumn column, Of of) : what(std::move(column)) {
            if constexpr (std::is_invocable_v<Of, TableCells&, const Row&>)
                cell = std::move(of);
            else {
                what.format = format_of<std::remove_cvref_t<std::invoke_result_t<Of&, const Row&>>>();
                cell = [of = std::move(of)](TableCells& to, const Row& row) { to.put(std::invoke(of, row)); };
            }
        }
    };

    RowLayout(std::string name, std::string description, std::vector<Column> columns)
        : table_{std::move(name), std::move(description), {}, {}} {
        add<Row>(std::move(columns));
    }

    /// More columns to the right, of rows of this kind or of one that it is made from.
    template <class Base> void add(std::vector<typename RowLayout<Base>::Column> columns) {
        for (auto& column : columns) {
            call_apart(column.what, column.is_named);
            if (column.is_named)
                named_.push_back(table_.columns.size());
            table_.columns.push_back(std::move(column.what));
            cells_.push_back(std::move(column.cell));
        }
    }

    /// Columns with one value in all rows, to the left of all others.
    void lead_with(std::vector<LeadingColumn> leading) { table_.leading = std::move(leading); }

    /// For the line of names and the dictionary.
    const Table& table() const { return table_; }

    /// Into a TableWriter or a TableText. Throws RecordError.
    template <class To> void write(To& to, const Row& row) const {
        for (const auto& cell : cells_)
            cell(to, row);
        to.end_row();
    }

  private:
    /// Before a column is added.
    void call_apart(TableColumn& column, bool is_named) {
        for (std::size_t i = 0; i < table_.columns.size(); ++i) {
            if (table_.columns[i].name != column.name)
                continue;
            const bool is_other_named = std::ranges::find(named_, i) != named_.end();
            TableColumn& renamed = is_named || !is_other_named ? column : table_.columns[i];
            renamed.name = "own_" + renamed.name;
        }
    }

    Table table_;
    std::vector<std::size_t> named_; ///< which columns a protocol has named
    std::vector<std::function<void(TableCells&, const Row&)>> cells_;
};

} // namespace overt
