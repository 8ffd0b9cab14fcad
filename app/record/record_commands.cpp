#include "app/record/record_commands.h"

#include <limits>

#include "app/cli/command_options.h"
#include "app/inputs/session_folders.h"

namespace overt {

namespace {

void add_import(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_import, "import",
                    "Makes an EyeLink recording (ASC) into a session, or its gaze into that of one",
                    "overt import p07.asc --observer 07 --screen-mm 698.4 392.9 --distance-mm 1750\n"
                    "  overt import p07.asc --into sessions/overt_2019/sub-07_ses-01");
    command
        .add_option(
            "FILE", options.files,
            "Recording in the text form that edf2asc writes; or two of one recording, its samples and its "
            "events (edf2asc -s and -e)")
        ->required()
        ->expected(1, std::numeric_limits<int>::max());
    option(
        command, "--into", options.into, "SESSION",
        "Make a copy of this session with the gaze of the file, trial by trial as its messages TRIALID say");
    option(command, "--out", options.out, "DIR",
           "The new session's folder (default: by task and observer in --sessions; with --into the session's "
           "name in a folder FOLDER_imports beside the FOLDER that holds it)");
    add_sessions_option(command, options.sessions);
    option(command, "--observer", options.observer, "ID",
           "Label of the observer (default: letters and digits of the file's name)");
    command.add_flag("--another-person", options.is_another_person,
                     "This observer is not the one whose label differs in case or leading zeros only");
    option(command, "--session", options.session_number, "N",
           "Number of the session (default: the next free one)", above_zero());
    option(command, "--task", options.task, "NAME", "Name for what was done", shown_default);
    option(command, "--screen-mm", options.screen_mm, "W H",
           "Width and height of the screen's picture, where the file does not say it", above_zero())
        ->expected(2);
    option(command, "--distance-mm", options.distance_mm, "MM",
           "From the eyes to the screen, where the file does not say it", above_zero());
    option(command, "--missing", options.missing, "VALUE",
           "What the file has in place of lost values (edf2asc -miss)")
        ->default_str("found by its lost samples");
    option(
        command, "--least-read", options.least_read, "SHARE",
        "Refuse a file if a smaller share of its samples or events can be read, in all or of one recording",
        CLI::Range(0.0, 1.0), shown_default);
    command.add_flag("--as-gaze", options.as_gaze,
                     "Samples that mostly lie off the screen are gaze, though the file does not say so");
    add_event_options(
        command, options.events,
        "Note that the session's fixations, saccades and blinks are to be found in its samples, in place of "
        "any that the file has, which stay on record");
    option(command, "--print-session-to", options.print_session_to, "FILE",
           "Write the session's path to this file, for scripts");
    add_json_flag(command, options.json);
}

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
    add_import(app, chosen);
    add_show(app, chosen);
    add_verify(app, chosen);
}

} // namespace overt
