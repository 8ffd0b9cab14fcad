/// `overt power`.
#pragma once

#include "app/cli/chosen_command.h"

namespace overt {

void add_power_command(CLI::App& app, ChosenCommand& chosen);

} // namespace overt
