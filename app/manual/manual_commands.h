/// The commands `completion` and, hidden, `man-pages`, which print what the table of commands says.
#pragma once

#include "app/cli/chosen_command.h"

namespace overt {

/// `app` has to live until the command was run; it is read then, with all commands that were added to it.
void add_manual_commands(CLI::App& app, ChosenCommand& chosen);

} // namespace overt
