/// Tables as text with separated cells, the same bytes on every machine, and fast.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiment/base/output_file.h"
#include "experiment/session_time.h"

namespace overt {

struct TableColumn {
    std::string name;
    std::string meaning;
    std::string unit = {};                                        ///< empty: none
    std::vector<std::pair<std::string, std::string>> levels = {}; ///< value and what it means; empty: any
    /// "string", "integer" or "number", as the dictionary's key Format has it; empty: a cell may be either.
    std::string_view format = {};
};

/// A number with so many decimals; missing if there is none.
struct Fixed {
    std::optional<double> number;
    int decimals;
};

/// What a column's cells are if each is put() a value of this type (TableColumn::format).
template <class Value> constexpr std::string_view format_of() {
    if constexpr (requires(const Value& value) { value.has_value(); })
        return format_of<std::remove_cvref_t<decltype(*std::declval<const Value&>())>>();
    else if constexpr (std::is_integral_v<Value>)
        return "integer";
    else if constexpr (std::is_same_v<Value, Fixed> || std::is_same_v<Value, SessionTime> ||
                       std::is_same_v<Value, SessionDuration>)
        return "number";
    else
        return "string";
}

/// A column at the left that has one value in all rows.
struct LeadingColumn {
    TableColumn what;
    std::string value;
    bool is_number = false;
};

/// One file of an export, and what stands in it.
struct Table {
    std::string name; ///< of the file, without its ending
    std::string description;
    std::vector<TableColumn> columns;        ///< whose cells are written
    std::vector<LeadingColumn> leading = {}; ///< before them

    /// Of the whole table, as its file has them.
    std::vector<TableColumn> all_columns() const;
};

/// How cells become lines, each with a newline at its end. Missing values and empty texts are n/a or null.
enum class TableFormat : std::uint8_t {
    tsv, ///< tabs between cells; in texts tab, newline, carriage return and backslash become \t, \n, \r and
         ///< \\.
    csv, ///< commas between cells; texts with a comma, quote or line break stand in quotes (RFC 4180)
    // In both, a text that a spreadsheet would take for a formula has an apostrophe before it (safe_text.h).
    jsonl, ///< each row a JSON object with the columns' names; numbers are numbers
};

/// What file names end with: "tsv", "csv" or "jsonl".
std::string_view ending_of(TableFormat format);

/// The table's name with that ending.
std::string file_name_of(const Table& table, TableFormat format);

/// A text as a cell: see TableWriter::ready().
std::string text_cell(std::string_view text, TableFormat format);

/// The line of column names with its newline; empty where the format has none.
std::string names_line(const Table& table, TableFormat format);

/// Makes the rows of one table, cell by cell from left to right. Nothing depends on a locale.
class TableCells {
  public:
    TableCells& text(std::string_view text);
    /// One that text_cell() made, for many rows.
    TableCells& ready(std::string_view cell);
    /// A word that needs no escaping in any format.
    TableCells& word(std::string_view word);
    TableCells& integer(std::int64_t number);
    /// With that many decimals (0 … 9), half away from zero; missing if it is no finite number.
    TableCells& fixed(double number, int decimals);
    /// Seconds with nine decimals: each nanosecond is kept.
    TableCells& seconds(SessionDuration duration);
    TableCells& seconds(SessionTime time) { return seconds(time.time_since_epoch()); }
    TableCells& missing();

    /// A value as its type has it: a Fixed, a whole number, a time, a text; nothing is missing.
    template <class Value> TableCells& put(const Value& value) {
        if constexpr (requires { value.has_value(); })
            return value ? put(*value) : missing();
        else if constexpr (std::is_same_v<Value, Fixed>)
            return value.number ? fixed(*value.number, value.decimals) : missing();
        else if constexpr (std::is_integral_v<Value>)
            return integer(value);
        else if constexpr (std::is_same_v<Value, SessionTime> || std::is_same_v<Value, SessionDuration>)
            return seconds(value);
        else
            return text(value);
    }

    /// Each column must have got its cell.
    void end_row();

    TableFormat format() const { return format_; }
    std::int64_t rows() const { return rows_; }

    TableCells(const TableCells&) = delete;
    TableCells& operator=(const TableCells&) = delete;

  protected:
    /// `into` must outlive this; it is not touched before the first cell.
    TableCells(const Table& table, TableFormat format, std::string& into);
    ~TableCells() = default;
    std::int64_t rows_ = 0;

  private:
    /// The text, with all that stands before the cell.
    std::string& begin_cell();

    std::string& into_;
    TableFormat format_;
    std::vector<std::string> before_; ///< what stands before the cell of each column
    std::size_t cells_ = 0;           ///< in the row so far
};

/// Rows in memory, for a TableWriter to take.
class TableText : public TableCells {
  public:
    TableText(const Table& table, TableFormat format) : TableCells(table, format, text_) {}
    const std::string& all() const { return text_; }

  private:
    std::string text_;
};

/// Writes the rows of one table into a file.
class TableWriter : public TableCells {
  public:
    enum class Header : std::uint8_t { names, none };

    /// Makes the table's NAME with the format's ending, and the line of column names where the format has
    /// one. Throws RecordError.
    TableWriter(const std::filesystem::path& directory, const Table& table, TableFormat format);

    /// Makes a file of any name. Throws RecordError.
    TableWriter(const std::filesystem::path& file, const Table& table, TableFormat format, Packing packing,
                Header header);

    /// Each column must have got its cell. Throws RecordError.
    void end_row() {
        TableCells::end_row();
        file_.flush_if_full();
    }
    /// Rows of the same table and format. Throws RecordError.
    void take(const TableText& rows);
    /// The same of a file that a TableWriter without a header has closed. Throws RecordError.
    void take(const std::filesystem::path& file, std::int64_t rows);

    std::int64_t bytes() const { return file_.size(); } ///< of text, before packing

    /// Brings the rest to the file. Throws RecordError.
    void close() { file_.close(); }

  private:
    OutputFile file_;
};

} // namespace overt
