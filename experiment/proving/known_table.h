/// Tables of known answers as they stand in the program.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/number_table.h"
#include "experiment/proving/known_answers.h"

namespace overt {

/// The cells of an embedded table by their columns' names.
class KnownTable {
  public:
    explicit KnownTable(std::string_view text) {
        TableLines lines(text);
        while (lines.next()) {
            std::vector<std::string> cells;
            for (const TableCell& cell : lines.cells())
                cells.emplace_back(cell.text);
            (header_.empty() ? header_ : rows_.emplace_back()) = std::move(cells);
        }
    }
    std::size_t size() const { return rows_.size(); }
    const std::vector<std::string>& header() const { return header_; }
    /// The column must be there.
    const std::string& text(std::size_t row, std::string_view column) const {
        std::size_t at = 0;
        while (header_[at] != column)
            ++at;
        return rows_[row][at];
    }
    double number(std::size_t row, std::string_view column) const { return std::stod(text(row, column)); }

  private:
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

/// The worst of several numbers that are compared alike.
class WorstAnswer {
  public:
    WorstAnswer(std::string what, double tolerance) : worst_{std::move(what), 0.0, 0.0, tolerance} {}
    void add(double known, double ours) {
        if (count_++ == 0 || !(std::abs(ours - known) <= std::abs(worst_.ours - worst_.known))) {
            worst_.known = known;
            worst_.ours = ours;
        }
    }
    /// Named with how many it stands for.
    KnownAnswer answer() const {
        KnownAnswer named = worst_;
        named.what += " (worst of " + std::to_string(count_) + ")";
        return named;
    }

  private:
    KnownAnswer worst_;
    int count_ = 0;
};

} // namespace overt
