/// The commands `analyze` and `replicate`.
#pragma once

#include "app/cli/chosen_command.h"

namespace overt {

// Each adds its command to the command line.
void add_analyze_command(CLI::App& app, ChosenCommand& chosen);
void add_replicate_command(CLI::App& app, ChosenCommand& chosen);

} // namespace overt
