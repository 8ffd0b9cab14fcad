#include "app/replay/replay_commands.h"

#include "app/cli/command_options.h"

namespace overt {

void add_replay_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_replay, "replay",
        "Presents a recorded session again, and compares all of it with the record",
        "overt replay sessions/overt_2019/sub-07_ses-01\n"
        "  overt replay sessions/overt_2019/sub-07_ses-01 --trial 3 --frame 12 --picture frame.png\n"
        "Exit codes: 0 all that was compared is the same, 1 something differs, 2 bad input.");
    command
        .add_option("SESSION", options.session,
                    "Folder of a session, or the session file in it; or a folder that holds a single one")
        ->required();
    option(command, "--files", options.files, "DIR",
           "Folder from which the paths in the protocol start (default: where its file lay, as seen from the "
           "session's folder)");
    CLI::Option* const trial = option(
        command, "--trial", options.trial, "TRIAL",
        "Instead, draw of this trial, counted from 1, what --picture or --movie asks for", above_zero());
    option(command, "--slot", options.slot, "SLOT",
           "Of a trial that shows several stimuli: in which slot, by its id (default: the first)")
        ->needs(trial);
    CLI::Option* const frame = option(
        command, "--frame", options.frame, "K",
        "Which of the frames that the trial showed, counted from 1 in the order of time", above_zero());
    CLI::Option* const picture = option(command, "--picture", options.picture, "FILE",
                                        "Write a PNG of that frame as it was displayed, with the gaze on "
                                        "it, and tell the point of the surface");
    CLI::Option* const movie = option(command, "--movie", options.movie, "FILE",
                                      "Write the trial as a movie with the gaze on it, by the program "
                                      "ffmpeg, in the format of the name's ending");
    picture->needs(trial)->needs(frame)->excludes(movie);
    movie->needs(trial)->excludes(frame);
    frame->needs(picture);
    command.add_flag("--overwrite", options.overwrite, "Replace a picture or movie that is there");
    add_json_flag(command, options.json);
    add_context_option(command, options.context);
}

} // namespace overt
