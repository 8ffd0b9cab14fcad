/// From words on the command line to a command with its options.
#pragma once

namespace overt {

/// Parses, runs the command, and gives the exit code: 0 done, 1 failed, 2 bad input.
int run_command_line(int argc, char** argv);

} // namespace overt
