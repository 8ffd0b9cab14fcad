/// The commands before an observer sits down: check, new, schema.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/chosen_command.h"

namespace overt {

void add_check_commands(CLI::App& app, ChosenCommand& chosen);

struct CheckOptions {
    std::filesystem::path protocol;
    std::string observer; ///< show this observer's order; empty: the first
    bool all_observers = false;
    double answer_time_s = 8.0;
    std::optional<std::uint64_t> seed; ///< of the orders shown, where the protocol fixes none
    bool frames = false;               ///< read every frame, and say what light of it the display cannot show
    bool json = false;
    std::filesystem::path screens; ///< folder for a picture of each screen; empty: none
};
int run_check(const CheckOptions& options);

struct NewOptions {
    std::filesystem::path protocol; ///< to write; never over a file that is there
    bool is_short = false;          ///< only the keys that one has to decide on
    std::string from = {};          ///< a protocol that comes with the program; empty: none
};
int run_new(const NewOptions& options);

/// Prints the JSON Schema of protocols.
int run_schema();

} // namespace overt
