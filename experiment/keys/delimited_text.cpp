#include "experiment/keys/delimited_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/text_number.h"
#include "experiment/base/utf8_text.h"

namespace overt {

namespace {

char separator_of(std::string_view text) {
    int semicolons = 0, commas = 0;
    bool is_quoted = false;
    for (const char character : text) {
        if (character == '"')
            is_quoted = !is_quoted;
        if (is_quoted)
            continue;
        if (character == '\n' || character == '\r')
            break;
        if (character == '\t')
            return '\t';
        semicolons += character == ';';
        commas += character == ',';
    }
    return semicolons > commas ? ';' : ',';
}

/// Goes through the text character by character, and knows where it is.
class CellReader {
  public:
    CellReader(std::string_view text, char separator, int number)
        : text_(text), separator_(separator), place_{1, 1, number} {}

    bool is_at_end() const { return next_ == text_.size(); }

    /// The cells of the next line; a single empty one of an empty line. `fault` says what is wrong with its
    /// quotes, if anything is.
    std::vector<TextCell> line(std::optional<std::pair<Place, std::string>>& fault) {
        std::vector<TextCell> cells;
        do
            cells.push_back(cell(fault));
        while (take_if(separator_));
        if (!is_at_end() && text_[next_] == '\r' && text_.substr(next_, 2) != "\r\n")
            end_line();
        else
            while (!is_at_end() && take() != '\n') {
            }
        return cells;
    }

  private:
    char take() {
        const char character = text_[next_++];
        if (character == '\n') {
            ++place_.line;
            place_.column = 1;
        } else if ((static_cast<unsigned char>(character) & 0xC0) != 0x80) { // not within a character
            ++place_.column;
        }
        return character;
    }
    void end_line() {
        ++next_;
        ++place_.line;
        place_.column = 1;
    }
    bool take_if(char character) {
        const bool is_it = !is_at_end() && text_[next_] == character;
        if (is_it)
            take();
        return is_it;
    }
    bool is_at_line_end() const { return is_at_end() || text_[next_] == '\n' || text_[next_] == '\r'; }
    void skip_blanks() {
        while (!is_at_end() && (text_[next_] == ' ' || (text_[next_] == '\t' && separator_ != '\t')))
            take();
    }

    TextCell cell(std::optional<std::pair<Place, std::string>>& fault) {
        skip_blanks();
        TextCell cell{{}, place_};
        if (take_if('"')) {
            while (!is_at_end()) {
                const char character = take();
                if (character == '"' && !take_if('"')) {
                    skip_blanks();
                    if (!is_at_line_end() && text_[next_] != separator_ && !fault)
                        fault = {place_, "more text after the quote that ends the cell"};
                    while (!is_at_line_end() && text_[next_] != separator_)
                        take();
                    return cell;
                }
                cell.text += character;
            }
            if (!fault)
                fault = {cell.place, "this quote is never closed"};
            return cell;
        }
        while (!is_at_line_end() && text_[next_] != separator_)
            cell.text += take();
        cell.text.erase(cell.text.find_last_not_of(" \t") + 1);
        return cell;
    }

    std::string_view text_;
    char separator_;
    std::size_t next_ = 0;
    Place place_;
};

std::string_view name_of_separator(char separator) {
    return separator == '\t' ? "tabs" : separator == ';' ? "semicolons" : "commas";
}

bool is_empty_line(const std::vector<TextCell>& cells) {
    return cells.size() == 1 && cells.front().text.empty();
}

} // namespace

std::optional<DelimitedText> parse_delimited(std::string_view text, const std::string& file, int number,
                                             Diagnostics& diagnostics) {
    const int errors_before = diagnostics.error_count();
    const auto error = [&](Place place, std::string message, std::string hint = {}) {
        diagnostics.error(file, place, std::move(message), std::move(hint));
    };
    if (!is_utf8(text) || text.find('\0') != std::string_view::npos) {
        error({1, 1, number}, "the table is not UTF-8", "save it as UTF-8: \"CSV UTF-8\" in a spreadsheet");
        return std::nullopt;
    }
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    DelimitedText table;
    table.separator = separator_of(text);
    CellReader reader(text, table.separator, number);
    while (!reader.is_at_end()) {
        std::optional<std::pair<Place, std::string>> fault;
        std::vector<TextCell> cells = reader.line(fault);
        if (fault)
            error(fault->first, fault->second, "a quote within a cell in quotes is written twice");
        if (is_empty_line(cells))
            continue;
        if (table.header.empty()) {
            table.header = std::move(cells);
            continue;
        }
        const bool is_ragged = cells.size() != table.header.size();
        if (is_ragged && !fault)
            error(cells.front().place,
                  fmt::format("{} in this row, {} in the header", counted(cells.size(), "cell"),
                              table.header.size()),
                  fmt::format("cells lie between {}; one that holds any stands in quotes",
                              name_of_separator(table.separator)));
        if (!is_ragged && !fault)
            table.rows.push_back(std::move(cells));
    }
    const int errors_in_rows = diagnostics.error_count();
    for (auto column = table.header.begin(); column != table.header.end(); ++column) {
        const auto earlier = std::ranges::find(table.header, column->text, &TextCell::text);
        if (column->text.empty())
            error(column->place, "a column without a name");
        else if (earlier != column)
            error(column->place, fmt::format("two columns are called \"{}\"", column->text),
                  fmt::format("the other is in column {}", earlier->place.column));
    }
    if (table.header.empty())
        error({1, 1, number}, "the table is empty", "its first line names the columns");
    else if (table.rows.empty() && errors_in_rows == errors_before)
        error(table.header.front().place, "the table has no rows below its header");
    if (diagnostics.error_count() > errors_in_rows)
        return std::nullopt;
    return table;
}

std::optional<double> number_in_cell(const DelimitedText& table, const TextCell& cell) {
    std::string text = cell.text;
    if (table.separator == ';')
        std::ranges::replace(text, ',', '.');
    const std::optional<double> number = number_in<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

} // namespace overt
