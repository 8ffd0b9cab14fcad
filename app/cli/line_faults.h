/// What a command line says that the program does not know, with what was probably meant.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace overt {

/// Of a line that `app` has refused to parse, all findings at once, each a whole line without its end:
/// options and commands that there are not, words too many, and what `error` says besides.
std::vector<std::string> line_faults(const CLI::App& app, const CLI::ParseError& error);

} // namespace overt
