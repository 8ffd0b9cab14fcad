#include "app/watch/watch_commands.h"

#include "app/cli/command_options.h"

namespace overt {

void add_watch_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<WatchOptions>();
    WatchOptions& options = *given;
    CLI::App& command = add_command(
        app, "watch", "The operator's view of a session that runs: progress, gaze, quality, commands",
        "overt watch sessions/overt_2019/sub-07_ses-01\n"
        "  overt watch --terminal --socket /run/user/1000/overt.sock\n"
        "  overt watch --once --send \"note observer moved the chair\"\n"
        "The session is begun with overt run … --operator-socket");
    command.add_option("SESSION", options.session,
                       "Folder of the session (default: the one that runs in --sessions)");
    command.add_option("--socket", options.socket, "Its socket, if that is not in its folder")
        ->type_name("FILE");
    command.add_option("--sessions", options.sessions, "Folder of all sessions")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_flag("--terminal", options.in_terminal,
                     "Text instead of a window, as where there is no display; commands are typed. Where "
                     "output is no terminal, a line for each "
                     "change");
    command.add_flag("--once", options.once, "Print the figures as text, and end");
    command
        .add_option(
            "--send", options.sends,
            "Sends a command without asking again, as \"skip 2\" or \"note TEXT\"; once for each command")
        ->type_name("COMMAND")
        ->allow_extra_args(false);
    run_when_chosen(command, chosen, [given] { return run_watch(*given); });
}

} // namespace overt
