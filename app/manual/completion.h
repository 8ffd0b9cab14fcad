/// Scripts by which a shell completes the words of a command line.
#pragma once

#include <string>

#include "app/manual/command_table.h"

namespace overt {

std::string bash_completion(const CommandEntry& program);
std::string zsh_completion(const CommandEntry& program);
std::string fish_completion(const CommandEntry& program);

} // namespace overt
