/// Texts that somebody else may have written (protocols, sessions, answers) on their way to a terminal or
/// into a spreadsheet, which would take some of them for commands.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// What a terminal shows and nothing else: control characters (C0 but newline and tab, DEL, C1) and
/// characters that turn the direction of writing become visible as "\x1b" or "\u202e". Bytes that are no
/// UTF-8 stay. From any thread.
std::string printable_text(std::string_view text);

/// A cell that spreadsheets take as text: where it begins with =, +, -, @, a tab or a carriage return and is
/// no number, and is longer than one character, an apostrophe stands before it (OWASP, "CSV injection").
/// Numbers stay as they are, whatever their sign.
std::string without_formula(std::string_view cell);

/// A text as a cell of a CSV file (RFC 4180), without a formula: in quotes where it holds a comma, a quote, a
/// line break or a blank at an end; empty texts are empty.
std::string csv_cell(std::string_view text);

} // namespace overt
