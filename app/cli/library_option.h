/// --library: which file a library of a device's maker is loaded from, for this run of the program.
#pragma once

#include <CLI/CLI.hpp>

namespace overt {

/// --library NAME=FILE, once for each library; puts FILE into the library's variable of the environment
/// (vendor_libraries). A name that is none, and a file that is not there, are bad input.
void add_library_option(CLI::App& command);

} // namespace overt
