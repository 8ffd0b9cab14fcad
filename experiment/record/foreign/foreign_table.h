/// Tables as other programs write them: rows of separated cells, plain or packed by gzip.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// Reads a table row by row, so that memory does not grow with it. Cells stand between tabs, commas or
/// semicolons, whichever the line of names has most of; they may be in quotes (RFC 4180), over several lines.
/// Lines before the names that begin with # are kept apart. A byte order mark is left out. One thread.
class ForeignTable {
  public:
    /// `names`: of the columns of a file that has no line of names, as BIDS has them. Throws InputError if
    /// the file cannot be read, is no text of rows, or has two columns of a name that is asked for.
    explicit ForeignTable(const std::filesystem::path& file, std::vector<std::string> names = {});
    ~ForeignTable();
    ForeignTable(ForeignTable&&) noexcept;

    const std::filesystem::path& file() const { return file_; }
    const std::vector<std::string>& columns() const { return columns_; }
    /// The names of the columns for a message: the first 40.
    std::string columns_in_words() const;
    const std::vector<std::string>& comments() const { return comments_; }

    /// The column of this name; else the only one of this name with a unit behind it in brackets: "TIME" is
    /// "TIME(f=10000000)", "L POR X" is "L POR X [px]". Nothing if there is none.
    std::optional<std::size_t> find(std::string_view name) const;
    bool has(std::string_view name) const { return find(name).has_value(); }
    /// Throws InputError that names the columns there are. `what`: for what it is needed, as the option says.
    std::size_t require(const std::string& name, std::string_view what) const;
    /// The same; nothing where the name is empty.
    std::optional<std::size_t> require_named(const std::string& name, std::string_view what) const {
        if (name.empty())
            return std::nullopt;
        return require(name, what);
    }

    /// Goes on to the next row that is not empty; false after the last. Throws InputError for a file that is
    /// damaged.
    bool next();
    /// Of the row: empty where it is shorter.
    std::string_view cell(std::size_t column) const {
        return column < cells_.size() ? std::string_view(cells_[column]) : std::string_view();
    }
    std::string_view cell(const std::optional<std::size_t>& column) const {
        return column ? cell(*column) : std::string_view();
    }
    /// Where the row is: "FILE:LINE".
    std::string place() const;

  private:
    bool read_line(std::string& line);
    void split(const std::string& line);

    struct Packed;
    std::filesystem::path file_;
    std::unique_ptr<Packed> packed_;
    char separator_ = ',';
    std::vector<std::string> columns_, comments_, cells_;
    std::int64_t line_ = 0, row_line_ = 0;
};

/// Whether a cell stands for nothing: empty, ".", "n/a", "NaN", "NA", "None", "null", "-" or "--".
bool is_missing_cell(std::string_view cell);

/// A number, with a decimal point or comma; nothing if it is none.
std::optional<double> number_in_cell(std::string_view cell);

/// What `COLUMN=NAME,COLUMN=NAME` or a list of it says: "time=TIME", "object=stim name". A comma that belongs
/// to a name is written "\,". Throws InputError for a word without "=", or a key that is not in `known`.
std::vector<std::pair<std::string, std::string>> column_words(const std::vector<std::string>& given,
                                                              const std::vector<std::string_view>& known,
                                                              std::string_view option);

} // namespace overt
