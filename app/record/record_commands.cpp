#include "app/record/record_commands.h"

#include "app/cli/command_options.h"
#include "app/inputs/session_folders.h"

namespace overt {

namespace {

void add_verify(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_verify, "verify",
                    "Whether sessions on disk are what was recorded, and where they are not",
                    "overt verify sessions/overt_2019/sub-*\n"
                    "  overt verify sessions/overt_2019/sub-07_ses-01 --json\n"
                    "Exit codes: 0 all are sound (an interrupted one, too), 1 one is damaged, 2 one is no "
                    "session, or of a "
                    "newer overt.");
    command.add_option("SESSION", options.sessions, sessions_help)->required();
    add_json_flag(command, options.json);
}

void add_show(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_show, "show", "What a session holds, and one trial as a picture",
                    "overt show sessions/overt_2019/sub-07_ses-01 --trial 3 --picture trial.png");
    command.add_option("SESSION", options.sessions, sessions_help)->required();
    option(command, "--trial", options.trial, "TRIAL",
           "Trial for --picture, counted from 1 (default: the first)", above_zero());
    option(
        command, "--slot", options.slot, "SLOT",
        "Of a trial that shows several stimuli: in which slot for --picture, by its id (default: the first)");
    option(command, "--picture", options.picture, "FILE",
           "Write a PNG: a frame, its map, and the gaze on the surface");
    option(command, "--plot", options.plot, "FILE",
           "Draw the presentations' timing, intervals of refreshes and trial by trial, to a .svg or .png");
    command.add_flag(
        "--order", options.order,
        "The planned order of trials, made again from the recorded protocol and seed; exit code 1 "
        "if that gives another");
    add_json_flag(command, options.json);
}

} // namespace

void add_record_commands(CLI::App& app, ChosenCommand& chosen) {
    add_export(app, chosen);
    add_show(app, chosen);
    add_verify(app, chosen);
}

} // namespace overt
