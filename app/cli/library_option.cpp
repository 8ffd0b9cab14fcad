#include "app/cli/library_option.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/command_options.h"
#include "experiment/base/diagnostics.h"
#include "experiment/ports/vendor_libraries.h"

namespace overt {
namespace {

/// What is wrong with the words of the option; empty: nothing.
std::string take_library(const std::string& words) {
    const std::size_t end = words.find('=');
    const std::string name = words.substr(0, end);
    std::vector<std::string_view> names;
    for (const VendorLibrary& library : vendor_libraries)
        names.push_back(library.name);
    if (end == std::string::npos || end + 1 == words.size())
        return fmt::format("\"{}\" is no NAME=FILE, such as lsl=/opt/lsl/liblsl.so; names are {}", words,
                           fmt::join(names, ", "));
    const auto* const found = std::ranges::find(vendor_libraries, name, &VendorLibrary::name);
    if (found == vendor_libraries.end())
        return fmt::format("there is no library \"{}\"; {}", name, suggest_name(name, names));
    const std::filesystem::path file = std::filesystem::absolute(words.substr(end + 1));
    if (!std::filesystem::is_regular_file(file))
        return fmt::format("{}: there is no such file", file.string());
    // Before anything is opened, and while the program has one thread.
    setenv(found->variable, file.c_str(), 1);
    return {};
}

} // namespace

void add_library_option(CLI::App& command) {
    command
        .add_option_function<std::vector<std::string>>(
            "--library", [](const std::vector<std::string>&) {},
            "File of a library of a device's maker, such as lsl=/opt/lsl/liblsl.so: eyelink, tobii or lsl; "
            "else the environment names it, or it is found where the system looks")
        ->type_name("NAME=FILE")
        ->allow_extra_args(false)
        ->check([](const std::string& words) { return take_library(words); });
}

} // namespace overt
