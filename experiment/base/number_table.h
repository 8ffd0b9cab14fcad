/// Tables of numbers in CSV files and in the program itself: gamma tables, spectra, readings.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"

namespace overt {

/// The text between two commas, without blanks or quotes at its ends, and where it begins. Commas between
/// quotes are part of the text; a quote within quotes is not.
struct TableCell {
    std::string_view text;
    Place place;

    /// The number that it is; nothing if it is none, or not finite.
    std::optional<double> number() const;
};

/// Goes through the lines of a table, passing over empty ones and those that begin with #. The text, which
/// may begin with a mark of UTF-8, must outlive the cells.
class TableLines {
  public:
    explicit TableLines(std::string_view text);

    /// Whether there is one more line; cells() are then its own.
    bool next();

    const std::vector<TableCell>& cells() const { return cells_; }
    std::string_view text() const { return line_; }
    int number() const { return number_; } ///< from 1

  private:
    std::string_view rest_, line_;
    std::vector<TableCell> cells_;
    int number_ = 0;
};

/// The columns asked for, row by row.
struct NumberTable {
    std::string file; ///< as findings name it
    std::string text; ///< byte for byte
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;  ///< one value for each of `columns`
    std::vector<std::vector<Place>> places; ///< of each value

    bool has(std::string_view column) const;
    /// All values of a column that is there.
    std::vector<double> column(std::string_view name) const;
    Place place(std::size_t row, std::string_view column) const;

  private:
    std::size_t index_of(std::string_view column) const;
};

/// A text file as a whole. What is wrong with it goes to `diagnostics` at `place` of `named_in`: the file is
/// not there, no file, unreadable, or larger than 4 MiB.
std::optional<std::string> read_whole_file(const std::filesystem::path& file, const std::string& named_in,
                                           Place place, Diagnostics& diagnostics);

/// Reads a table: lines of numbers between commas under a line of column names, in any order; lines that
/// begin with # are passed over. All `required` columns must be there, and no others but `optional` ones; an
/// empty `required` takes any columns. Findings go to `diagnostics` with their places in `file`; nothing if
/// one of them is an error.
std::optional<NumberTable> read_number_table(std::string text, const std::string& file,
                                             std::span<const std::string_view> required,
                                             std::span<const std::string_view> optional,
                                             Diagnostics& diagnostics);

/// The rows of a table of so many columns that is built into the program, where any fault is a mistake in the
/// program.
std::vector<std::vector<double>> rows_of_table(std::string_view table, std::size_t columns);

} // namespace overt
