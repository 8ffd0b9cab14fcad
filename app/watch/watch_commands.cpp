#include "app/watch/watch_commands.h"

#include "app/cli/command_options.h"

namespace overt {

void add_watch_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_watch, "watch",
                    "The operator's view of a session that runs: progress, gaze, quality, commands",
                    "overt watch sessions/overt_2019/sub-07_ses-01\n"
                    "  overt watch --terminal --operator-socket /run/user/1000/overt.sock\n"
                    "  overt watch --once --send \"note observer moved the chair\"\n"
                    "The session is begun with overt run … --operator-socket");
    command.add_option(
        "SESSION", options.session,
        "Folder of the session, or one that holds it (default: the one that runs in --sessions)");
    option(command, "--operator-socket", options.socket, "FILE", "Its socket, if that is not in its folder");
    add_sessions_option(command, options.sessions);
    command.add_flag("--terminal", options.in_terminal,
                     "Text instead of a window, as where there is no display; commands are typed. Where "
                     "output is no terminal, a line for each "
                     "change");
    command.add_flag("--once", options.once, "Print the figures as text, and end");
    option(command, "--send", options.sends, "COMMAND",
           "Sends a command without asking again, as \"skip 2\" or \"note TEXT\"; once for each command",
           one_each_time);
}

} // namespace overt
