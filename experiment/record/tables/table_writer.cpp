#include "experiment/record/tables/table_writer.h"

#include <cmath>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/number_text.h"
#include "experiment/base/safe_text.h"

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

std::string_view separator_of(TableFormat format) {
    return format == TableFormat::tsv ? "\t" : format == TableFormat::csv ? "," : "";
}

std::string_view missing_in(TableFormat format) { return format == TableFormat::jsonl ? "null" : "n/a"; }

/// What a row has before each of its cells: before the first also the leading columns.
std::vector<std::string> befores(const Table& table, TableFormat format) {
    std::vector<std::string> list;
    std::string before = format == TableFormat::jsonl ? "{" : "";
    const auto begin = [&](const std::string& name) {
        if (format == TableFormat::jsonl)
            before += json_quoted(name) + ':';
    };
    const std::string_view separator = format == TableFormat::jsonl ? "," : separator_of(format);
    for (const LeadingColumn& column : table.leading) {
        begin(column.what.name);
        before += column.is_number ? column.value : text_cell(column.value, format);
        before += separator;
    }
    for (const TableColumn& column : table.columns) {
        begin(column.name);
        list.push_back(std::exchange(before, std::string(separator)));
    }
    return list;
}

} // namespace

std::vector<TableColumn> Table::all_columns() const {
    std::vector<TableColumn> all;
    for (const LeadingColumn& column : leading) {
        all.push_back(column.what);
        const bool is_whole = column.value.find('.') == std::string::npos;
        all.back().format = !column.is_number ? "string" : is_whole ? "integer" : "number";
    }
    all.insert(all.end(), columns.begin(), columns.end());
    return all;
}

std::string_view ending_of(TableFormat format) {
    return format == TableFormat::tsv ? "tsv" : format == TableFormat::csv ? "csv" : "jsonl";
}

std::string file_name_of(const Table& table, TableFormat format) {
    return fmt::format("{}.{}", table.name, ending_of(format));
}

std::string text_cell(std::string_view text, TableFormat format) {
    if (text.empty())
        return std::string(missing_in(format));
    switch (format) {
    case TableFormat::tsv:
        return escaped(without_formula(text));
    case TableFormat::csv:
        return csv_cell(text);
    case TableFormat::jsonl:
        break;
    }
    return json_quoted(text);
}

std::string names_line(const Table& table, TableFormat format) {
    std::string names;
    if (format == TableFormat::jsonl)
        return names;
    for (const TableColumn& column : table.all_columns()) {
        if (!names.empty())
            names += separator_of(format);
        names += text_cell(column.name, format);
    }
    return names + '\n';
}

TableCells::TableCells(const Table& table, TableFormat format, std::string& into)
    : into_(into), format_(format), before_(befores(table, format)) {}

std::string& TableCells::begin_cell() {
    OVERT_EXPECTS(cells_ < before_.size());
    return into_ += before_[cells_++];
}

TableCells& TableCells::text(std::string_view text) {
    begin_cell() += text_cell(text, format_);
    return *this;
}

TableCells& TableCells::ready(std::string_view cell) {
    begin_cell() += cell;
    return *this;
}

TableCells& TableCells::word(std::string_view word) {
    std::string& text = begin_cell();
    if (format_ != TableFormat::jsonl) {
        text += word;
        return *this;
    }
    text += '"';
    text += word;
    text += '"';
    return *this;
}

TableCells& TableCells::integer(std::int64_t number) {
    append_scaled(begin_cell(), number, 0);
    return *this;
}

TableCells& TableCells::fixed(double number, int decimals) {
    if (!std::isfinite(number))
        return missing();
    append_fixed(begin_cell(), number, decimals);
    return *this;
}

TableCells& TableCells::seconds(SessionDuration duration) {
    append_scaled(begin_cell(), duration.count(), 9);
    return *this;
}

TableCells& TableCells::missing() {
    begin_cell() += missing_in(format_);
    return *this;
}

void TableCells::end_row() {
    OVERT_EXPECTS(cells_ == before_.size());
    into_ += format_ == TableFormat::jsonl ? "}\n" : "\n";
    cells_ = 0;
    ++rows_;
}

TableWriter::TableWriter(const std::filesystem::path& directory, const Table& table, TableFormat format)
    : TableWriter(directory / file_name_of(table, format), table, format, Packing::none,
                  format == TableFormat::jsonl ? Header::none : Header::names) {}

TableWriter::TableWriter(const std::filesystem::path& file, const Table& table, TableFormat format,
                         Packing packing, Header header)
    : TableCells(table, format, file_.text()), file_(file, packing) {
    if (header == Header::none)
        return;
    file_.text() += names_line(table, format);
}

void TableWriter::take(const TableText& rows) {
    file_.text() += rows.all();
    rows_ += rows.rows();
    file_.flush_if_full();
}

void TableWriter::take(const std::filesystem::path& file, std::int64_t rows) {
    std::ifstream from(file, std::ios::binary);
    std::vector<char> piece(std::size_t{1} << 18);
    std::int64_t taken = 0;
    while (from.read(piece.data(), static_cast<std::streamsize>(piece.size())) || from.gcount() > 0) {
        file_.text().append(piece.data(), static_cast<std::size_t>(from.gcount()));
        taken += from.gcount();
        file_.flush_if_full();
    }
    if (taken != static_cast<std::int64_t>(std::filesystem::file_size(file)))
        throw RecordError(fmt::format("{}: cannot be read again. Check the disk.", file.string()));
    rows_ += rows;
}

} // namespace overt
