/// The command `analyze`.
#pragma once

#include "app/cli/chosen_command.h"

namespace overt {

/// Adds it to the command line.
void add_analyze_command(CLI::App& app, ChosenCommand& chosen);

} // namespace overt
