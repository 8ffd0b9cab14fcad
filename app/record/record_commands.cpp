#include "app/record/record_commands.h"

#include <limits>

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_import(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ImportOptions>();
    ImportOptions& options = *given;
    CLI::App& command = add_command(
        app, "import", "Makes an EyeLink recording (ASC) into a session, or its gaze into that of one",
        "overt import p07.asc --observer 07 --screen-mm 698.4 392.9 --distance-mm 1750\n"
        "  overt import p07.asc --into sessions/overt_2019/sub-07_ses-01");
    command
        .add_option(
            "FILE", options.files,
            "Recording in the text form that edf2asc writes; or two of one recording, its samples and its "
            "events (edf2asc -s and -e)")
        ->required()
        ->expected(1, std::numeric_limits<int>::max());
    command
        .add_option("--into", options.into,
                    "Make a copy of this session with the gaze of the file, trial by trial as its messages "
                    "TRIALID say")
        ->type_name("SESSION");
    command
        .add_option("--out", options.out,
                    "The new session's folder (default: by task and observer in --sessions; with --into "
                    "the session's name in a folder FOLDER_imports beside the FOLDER that holds it)")
        ->type_name("DIR");
    command.add_option("--sessions", options.sessions, "Folder of all sessions")
        ->type_name("DIR")
        ->capture_default_str();
    command
        .add_option("--observer", options.observer,
                    "Label of the observer (default: letters and digits of the file's name)")
        ->type_name("LABEL");
    command
        .add_option("--session", options.session_number, "Number of the session (default: the next free one)")
        ->type_name("N")
        ->check(above_zero());
    command.add_option("--task", options.task, "Name for what was done")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option("--screen-mm", options.screen_mm,
                    "Width and height of the screen's picture, where the file does not say it")
        ->expected(2)
        ->type_name("W H")
        ->check(above_zero());
    command
        .add_option("--distance-mm", options.distance_mm,
                    "From the eyes to the screen, where the file does not say it")
        ->type_name("MM")
        ->check(above_zero());
    command
        .add_option("--print-session-to", options.print_session_to,
                    "Write the new session's path into a file")
        ->type_name("FILE");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_import(*given); });
}

void add_verify(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<VerifyOptions>();
    VerifyOptions& options = *given;
    CLI::App& command =
        add_command(app, "verify", "Whether sessions on disk are what was recorded, and where they are not",
                    "overt verify sessions/overt_2019/sub-*\n"
                    "  overt verify sessions/overt_2019/sub-07_ses-01 --json\n"
                    "Exit codes: 0 all are sound (an interrupted one, too), 1 one is damaged, 2 one is no "
                    "session, or of a "
                    "newer overt.");
    command.add_option("SESSION", options.sessions, "Folders of sessions")->required();
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_verify(*given); });
}

void add_show(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ShowOptions>();
    ShowOptions& options = *given;
    CLI::App& command =
        add_command(app, "show", "What a session holds, and one trial as a picture",
                    "overt show sessions/overt_2019/sub-07_ses-01 --trial 3 --picture trial.png");
    command.add_option("SESSION", options.session, "Folder of a session")->required();
    command.add_option("--trial", options.trial, "Trial for --picture, counted from 1 (default: the first)")
        ->type_name("N")
        ->check(above_zero());
    command
        .add_option("--picture", options.picture,
                    "Write a PNG: a frame, its map, and the gaze on the surface")
        ->type_name("FILE");
    command
        .add_option(
            "--plot", options.plot,
            "Draw the presentations' timing, intervals of refreshes and trial by trial, to a .svg or .png")
        ->type_name("FILE");
    command.add_flag(
        "--order", options.order,
        "The planned order of trials, made again from the recorded protocol and seed; exit code 1 "
        "if that gives another");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_show(*given); });
}

} // namespace

void add_record_commands(CLI::App& app, ChosenCommand& chosen) {
    add_export(app, chosen);
    add_import(app, chosen);
    add_show(app, chosen);
    add_verify(app, chosen);
}

} // namespace overt
