/// A table as a text file: comma, semicolon or tab between its cells, as spreadsheets write it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"

namespace overt {

struct TextCell {
    std::string text; ///< without quotes, and without blanks at its ends
    Place place;      ///< of its first character
};

struct DelimitedText {
    char separator = ',';
    std::vector<TextCell> header;
    std::vector<std::vector<TextCell>> rows; ///< each as long as the header
};

/// Reads a text with a header line. The separator is the one that the header has: a tab where there is one,
/// or else the more frequent of semicolon and comma. A cell in quotes may hold the separator, a line's end,
/// and a quote written twice. A byte order mark, CR LF and empty lines are passed over. What is wrong goes to
/// `diagnostics` under `file`, all of it. Files of another encoding, columns without a name or of one name,
/// and a table without rows give nothing; rows with more or fewer cells are left out. `number` is Place::file
/// of all places.
std::optional<DelimitedText> parse_delimited(std::string_view text, const std::string& file, int number,
                                             Diagnostics& diagnostics);

/// The number that a cell is: a finite one. Where cells lie between semicolons, a comma may stand for the
/// point.
std::optional<double> number_in_cell(const DelimitedText& table, const TextCell& cell);

} // namespace overt
