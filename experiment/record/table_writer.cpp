#include "experiment/record/table_writer.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/record/number_text.h"

namespace overt {
namespace {

std::string escaped(std::string_view text) {
    std::string cell;
    for (const char c : text) {
        switch (c) {
        case '\t':
            cell += "\\t";
            break;
        case '\n':
            cell += "\\n";
            break;
        case '\r':
            cell += "\\r";
            break;
        case '\\':
            cell += "\\\\";
            break;
        default:
            cell += c;
        }
    }
    return cell;
}

/// Blanks at the ends are quoted, too: some readers take them away otherwise.
std::string quoted(std::string_view text) {
    const bool is_plain =
        text.find_first_of(",\"\r\n") == std::string_view::npos && text.front() != ' ' && text.back() != ' ';
    if (is_plain)
        return std::string(text);
    std::string cell = "\"";
    for (const char c : text) {
        if (c == '"')
            cell += '"';
        cell += c;
    }
    return cell + '"';
}

} // namespace

std::string_view ending_of(TableFormat format) { return format == TableFormat::tsv ? "tsv" : "csv"; }

std::string text_cell(std::string_view text, TableFormat format) {
    if (text.empty())
        return "n/a";
    return format == TableFormat::tsv ? escaped(text) : quoted(text);
}

PreparedCells prepare_cells(std::initializer_list<std::string_view> texts, TableFormat format) {
    PreparedCells cells;
    for (const std::string_view text : texts) {
        if (cells.count++ > 0)
            cells.text += format == TableFormat::tsv ? '\t' : ',';
        cells.text += text_cell(text, format);
    }
    return cells;
}

TableWriter::TableWriter(const std::filesystem::path& directory, const Table& table, TableFormat format)
    : TableWriter(directory / fmt::format("{}.{}", table.name, ending_of(format)), table, format,
                  Packing::none, Header::names) {}

TableWriter::TableWriter(const std::filesystem::path& file, const Table& table, TableFormat format,
                         Packing packing, Header header)
    : file_(file, packing), format_(format), separator_(format == TableFormat::tsv ? '\t' : ','),
      columns_(static_cast<int>(table.columns.size())) {
    if (header == Header::none)
        return;
    for (const TableColumn& column : table.columns)
        text(column.name);
    end_row();
    rows_ = 0;
}

std::string& TableWriter::begin_cell() {
    if (cells_++ > 0)
        file_.text() += separator_;
    return file_.text();
}

TableWriter& TableWriter::text(std::string_view text) { return word(text_cell(text, format_)); }

TableWriter& TableWriter::prepared(const PreparedCells& cells) {
    begin_cell() += cells.text;
    cells_ += cells.count - 1;
    return *this;
}

TableWriter& TableWriter::word(std::string_view word) {
    begin_cell() += word;
    return *this;
}

TableWriter& TableWriter::integer(std::int64_t number) {
    append_scaled(begin_cell(), number, 0);
    return *this;
}

TableWriter& TableWriter::fixed(double number, int decimals) {
    if (!std::isfinite(number))
        return missing();
    append_fixed(begin_cell(), number, decimals);
    return *this;
}

TableWriter& TableWriter::seconds(SessionDuration duration) {
    append_scaled(begin_cell(), duration.count(), 9);
    return *this;
}

TableWriter& TableWriter::missing(int cells) {
    for (int i = 0; i < cells; ++i)
        word("n/a");
    return *this;
}

void TableWriter::end_row() {
    OVERT_EXPECTS(cells_ == columns_);
    file_.text() += '\n';
    cells_ = 0;
    ++rows_;
    file_.flush_if_full();
}

} // namespace overt
