/// The command with which an operator watches a session from another process.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"

namespace overt {

void add_watch_commands(CLI::App& app, ChosenCommand& chosen);

struct WatchOptions {
    std::filesystem::path session;               ///< folder of a session; empty: not given
    std::filesystem::path socket;                ///< instead; empty: not given
    std::filesystem::path sessions = "sessions"; ///< where one that runs is looked for, if neither is given
    bool in_terminal = false;
    bool once = false;              ///< prints what there is, and ends
    std::vector<std::string> sends; ///< commands that are sent as soon as it is connected
};

/// Gives 0 when the session is over, or the operator leaves. Throws InputError if there is no session to
/// watch or a command is none, and DeviceError if the session does not answer.
int run_watch(const WatchOptions& options);

/// Where the session's socket is. Throws InputError that says what to give.
std::filesystem::path socket_of(const WatchOptions& options);

} // namespace overt
