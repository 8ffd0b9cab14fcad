#include "experiment/base/number_table.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

int characters_in(std::string_view text) {
    return static_cast<int>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<TableCell> cells_of(std::string_view line, int number) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<TableCell> cells;
    for (std::size_t begin = 0; begin <= line.size();) {
        std::size_t first = std::min(line.find_first_not_of(blanks, begin), line.size());
        std::size_t end = std::min(line.find(',', first), line.size());
        // What is quoted may hold commas; a quote that nothing closes is one of the text.
        const std::size_t closing =
            line.substr(first).starts_with('"') ? line.find('"', first + 1) : line.npos;
        const std::size_t after =
            closing == line.npos ? line.npos : line.find_first_not_of(blanks, closing + 1);
        const bool is_quoted = closing != line.npos && (after == line.npos || line[after] == ',');
        std::size_t last = end;
        if (is_quoted) {
            end = std::min(after, line.size());
            ++first;
            last = closing;
        }
        while (!is_quoted && last > first && blanks.find(line[last - 1]) != std::string_view::npos)
            --last;
        cells.push_back(
            {line.substr(first, last - first), {number, characters_in(line.substr(0, first)) + 1}});
        begin = end + 1;
    }
    return cells;
}

class TableWalk {
  public:
    TableWalk(NumberTable& table, std::span<const std::string_view> required,
              std::span<const std::string_view> optional, Diagnostics& diagnostics)
        : table_(table), required_(required), optional_(optional), diagnostics_(diagnostics) {}

    void read() {
        TableLines lines(table_.text);
        while (faults_ < most_faults && lines.next()) {
            if (table_.columns.empty())
                read_header(lines);
            else
                read_row(lines);
        }
        if (table_.columns.empty())
            fault({}, "the table has no line of column names", header_hint());
        else if (table_.rows.empty() && faults_ == 0)
            fault({}, "the table has no lines of numbers");
    }

  private:
    static constexpr int most_faults = 20; ///< a file of another kind would fill the screen

    void fault(Place place, std::string message, std::string hint = {}) {
        ++faults_;
        diagnostics_.error(table_.file, place, std::move(message), std::move(hint));
    }

    std::string header_hint() const {
        return required_.empty() ? std::string()
                                 : fmt::format("the first line is to be {}", fmt::join(required_, ","));
    }

    void read_header(const TableLines& line) {
        std::vector<std::string_view> known(required_.begin(), required_.end());
        known.insert(known.end(), optional_.begin(), optional_.end());
        for (const TableCell& cell : line.cells()) {
            const bool is_known =
                required_.empty() || std::find(known.begin(), known.end(), cell.text) != known.end();
            if (!is_known)
                fault(cell.place, fmt::format("unknown column \"{}\"", cell.text),
                      suggest_name(cell.text, known));
            else if (table_.has(cell.text))
                fault(cell.place, fmt::format("a second column \"{}\"", cell.text));
            table_.columns.emplace_back(cell.text);
        }
        for (const std::string_view name : required_) {
            if (!table_.has(name))
                fault({line.number(), 1}, fmt::format("there is no column \"{}\"", name), header_hint());
        }
        // Without its columns the rest only repeats the fault.
        if (faults_ > 0)
            faults_ = most_faults;
    }

    void read_row(const TableLines& line) {
        const std::vector<TableCell>& cells = line.cells();
        if (cells.size() != table_.columns.size()) {
            fault(
                {line.number(), 1},
                fmt::format("{} columns where the line of names has {}", cells.size(), table_.columns.size()),
                line.text().find(';') != std::string_view::npos
                    ? "write commas between columns, and points for decimals"
                    : "");
            return;
        }
        std::vector<double> values;
        std::vector<Place> places;
        for (const TableCell& cell : cells) {
            const std::optional<double> value = cell.number();
            if (!value)
                return fault(cell.place, fmt::format("\"{}\" is no number", cell.text));
            values.push_back(*value);
            places.push_back(cell.place);
        }
        table_.rows.push_back(std::move(values));
        table_.places.push_back(std::move(places));
    }

    NumberTable& table_;
    std::span<const std::string_view> required_, optional_;
    Diagnostics& diagnostics_;
    int faults_ = 0;
};

} // namespace

std::optional<double> TableCell::number() const {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const bool is_number = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value);
    return is_number ? std::optional(value) : std::nullopt;
}

TableLines::TableLines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF"))
        rest_.remove_prefix(3);
}

bool TableLines::next() {
    while (!rest_.empty()) {
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++number_;
        const std::size_t first = line_.find_first_not_of(" \t\r");
        if (first == std::string_view::npos || line_[first] == '#')
            continue;
        cells_ = cells_of(line_, number_);
        return true;
    }
    return false;
}

bool NumberTable::has(std::string_view column) const {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::size_t NumberTable::index_of(std::string_view column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    OVERT_EXPECTS(found != columns.end());
    return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> NumberTable::column(std::string_view name) const {
    const std::size_t index = index_of(name);
    std::vector<double> values;
    for (const std::vector<double>& row : rows)
        values.push_back(row[index]);
    return values;
}

Place NumberTable::place(std::size_t row, std::string_view column) const {
    return places.at(row).at(index_of(column));
}

std::optional<std::string> read_whole_file(const std::filesystem::path& file, const std::string& named_in,
                                           Place place, Diagnostics& diagnostics) {
    // Far more than any table of ours: somebody gave a picture.
    constexpr std::size_t largest_bytes = 4 << 20;
    const auto refuse = [&](std::string message, std::string hint = {}) {
        diagnostics.error(named_in, place, std::move(message), std::move(hint));
        return std::nullopt;
    };
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        return refuse(fmt::format("there is no file {}", file.string()));
    if (!std::filesystem::is_regular_file(file, ignored))
        return refuse(fmt::format("{} is no file", file.string()));
    int error = 0;
    std::optional<std::string> text = read_whole_file(file, largest_bytes, error);
    if (error == EFBIG)
        return refuse(fmt::format("{} is larger than 4 MiB: it is no table of numbers", file.string()));
    if (!text)
        return refuse(fmt::format("{} cannot be read: {}", file.string(), std::strerror(error)));
    return *std::move(text);
}

std::optional<NumberTable> read_number_table(std::string text, const std::string& file,
                                             std::span<const std::string_view> required,
                                             std::span<const std::string_view> optional,
                                             Diagnostics& diagnostics) {
    const int errors_before = diagnostics.error_count();
    NumberTable table;
    table.file = file;
    table.text = std::move(text);
    diagnostics.quote_from(file, table.text);
    TableWalk(table, required, optional, diagnostics).read();
    if (diagnostics.error_count() > errors_before)
        return std::nullopt;
    return table;
}

std::vector<std::vector<double>> rows_of_table(std::string_view table, std::size_t columns) {
    Diagnostics diagnostics;
    std::optional<NumberTable> read = read_number_table(std::string(table), {}, {}, {}, diagnostics);
    OVERT_EXPECTS(read && read->columns.size() == columns);
    return std::move(read->rows);
}

} // namespace overt
