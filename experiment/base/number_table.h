/// Tables of numbers that are built into the program.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace overt {

/// The rows below the header line of a table whose columns are separated by one character; lines that begin
/// with «#» are comments. What is no number, or a row that is too short, is a mistake in the program.
std::vector<std::vector<double>> rows_of_table(std::string_view table, std::size_t columns);

} // namespace overt
