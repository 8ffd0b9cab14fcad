/// The command doctor: what a machine offers, and a lab's first day with its hardware.
#pragma once

#include "app/cli/chosen_command.h"

namespace overt {

void add_doctor_command(CLI::App& app, ChosenCommand& chosen);

} // namespace overt
