#include "app/import/import_commands.h"

#include <limits>

#include "app/cli/command_options.h"
#include "experiment/base/error.h"

namespace overt {

void add_import_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_any_import, "import",
                    "Makes what other programs presented and recorded into a session",
                    "overt import p07.asc --observer 07 --screen-mm 698.4 392.9 --distance-mm 1750\n"
                    "  overt import p07.asc --into sessions/overt_2019/sub-07_ses-01\n"
                    "  overt import all_gaze.csv --protocol shown.toml --trial-log trials.csv --observer 07\n"
                    "  overt import gaze.csv --protocol shown.toml --columns time=t,x=gx,y=gy,mark=msg "
                    "--trial-log psychopy.csv "
                    "--trial-columns onset=face.started,marker=msg");
    command
        .add_option(
            "FILE", options.of_gaze.files,
            "Recording of an EyeLink in the text form that edf2asc writes, or two of one recording, "
            "its samples and its "
            "events (edf2asc -s and -e); with --protocol that, too, or a table of gaze of any program, and "
            "files of its marks")
        ->required()
        ->expected(1, std::numeric_limits<int>::max());
    option(command, "--protocol", options.protocol, "PROTOCOL",
           "What was shown: the session knows its objects, and all that follows works as for a session of "
           "overt's own");
    option(command, "--trial-log", options.trials, "FILE",
           "With --protocol: log of the trials (CSV, TSV, PsychoPy, OpenSesame, BIDS events; default: the "
           "column of the gaze itself that names what was shown, or an EyeLink's messages)");
    option(command, "--frame-log", options.frames, "FILE",
           "With --protocol: log of the frames, or of the object's angles, that were shown (default: as the "
           "protocol plans them)");
    option(command, "--columns", options.columns, "KEY=COLUMN,…",
           "With --protocol: columns of gaze (time, x, y, pupil, validity, left_x … right_validity, eye, "
           "mark, trial) and "
           "time_unit, unit (px, normalised, degrees), valid, least_validity, y_up, zero_is_lost (default: "
           "by the file's program)");
    option(command, "--trial-columns", options.trial_columns, "KEY=COLUMN,…",
           "With --protocol: columns of the log of trials (onset, end, duration, marker, marker_text, "
           "marker_time, answer, response_time, "
           "correct, key, stimulus, object, material …) and unit (s, ms, us, ns)");
    option(command, "--frame-columns", options.frame_columns, "KEY=COLUMN,…",
           "With --protocol: columns of the log of frames (time, frame or angle, key) and unit");
    add_context_option(command, options.context);
    option(
        command, "--into", options.of_gaze.into, "SESSION",
        "Make a copy of this session with the gaze of the file, trial by trial as its messages TRIALID say");
    option(command, "--out", options.of_gaze.out, "DIR",
           "The new session's folder (default: by task and observer in --sessions; with --into the session's "
           "name in a folder FOLDER_imports beside the FOLDER that holds it)");
    add_sessions_option(command, options.of_gaze.sessions);
    option(command, "--observer", options.of_gaze.observer, "ID",
           "Label of the observer (default: letters and digits of the file's name)");
    command.add_flag("--another-person", options.of_gaze.is_another_person,
                     "This observer is not the one whose label differs in case or leading zeros only");
    option(command, "--session", options.of_gaze.session_number, "N",
           "Number of the session (default: the next free one)", above_zero());
    option(command, "--task", options.of_gaze.task, "NAME", "Name for what was done", shown_default);
    option(command, "--screen-mm", options.of_gaze.screen_mm, "W H",
           "Width and height of the screen's picture, where the file does not say it", above_zero())
        ->expected(2);
    option(command, "--distance-mm", options.of_gaze.distance_mm, "MM",
           "From the eyes to the screen, where the file does not say it", above_zero());
    option(command, "--missing", options.of_gaze.missing, "VALUE",
           "What the file has in place of lost values (edf2asc -miss)")
        ->default_str("found by its lost samples");
    option(
        command, "--least-read", options.of_gaze.least_read, "SHARE",
        "Refuse a file if a smaller share of its samples or events can be read, in all or of one recording",
        CLI::Range(0.0, 1.0), shown_default);
    command.add_flag("--as-gaze", options.of_gaze.as_gaze,
                     "Samples that mostly lie off the screen are gaze, though the file does not say so");
    add_event_options(
        command, options.of_gaze.events,
        "Note that the session's fixations, saccades and blinks are to be found in its samples, in place of "
        "any that the file has, which stay on record");
    option(command, "--print-session-to", options.of_gaze.print_session_to, "FILE",
           "Write the session's path to this file, for scripts");
    add_json_flag(command, options.of_gaze.json);
}

int run_any_import(const ForeignImportOptions& options) {
    if (!options.protocol.empty())
        return run_foreign_import(options);
    for (const auto& [name, is_given] : {std::pair{"--trial-log", !options.trials.empty()},
                                         {"--frame-log", !options.frames.empty()},
                                         {"--columns", !options.columns.empty()},
                                         {"--trial-columns", !options.trial_columns.empty()},
                                         {"--frame-columns", !options.frame_columns.empty()}})
        if (is_given)
            throw InputError(std::string(name) + " needs --protocol, which says what was shown");
    return run_import(options.of_gaze);
}

} // namespace overt
