/// What the commands of the command line are put together from. Options live as long as the command that
/// reads them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// A command with its example under its help.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& what,
                      const std::string& example);

/// `run` is what `command` does.
void run_when_chosen(CLI::App& command, ChosenCommand& chosen, ChosenCommand run);

/// Checks for numbers, finite ones: above 0; 0 or above.
CLI::Validator above_zero();
CLI::Validator not_negative();

/// --context
void add_context_option(CLI::App& command, ContextChoice& context);

/// --quality, one of `names`.
CLI::Option* add_quality_option(CLI::App& command, std::optional<BakeQuality>& quality,
                                const std::string& what, const std::vector<std::string>& names);

/// Checks of seeds, whole numbers that 64 bits hold, and of what lasts up to an hour.
CLI::Validator seed_number();
CLI::Validator seconds_up_to_an_hour();

/// --frame K or all, required; `what` says what becomes of either.
void add_frame_option(CLI::App& command, std::optional<int>& frame, const std::string& what);

} // namespace overt
