#include "app/replay/replay_commands.h"

#include "app/cli/command_options.h"

namespace overt {

void add_replay_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<ReplayOptions>();
    ReplayOptions& options = *given;
    CLI::App& command = add_command(
        app, "replay", "Presents a recorded session again, and compares all of it with the record",
        "overt replay sessions/overt_2019/sub-07_ses-01\n"
        "Exit codes: 0 all that was compared is the same, 1 something differs, 2 bad input.");
    command.add_option("SESSION", options.session, "Folder of a session, or the session file in it")
        ->required();
    command
        .add_option("--files", options.files,
                    "Folder from which the paths in the protocol start (default: where its file lay, as seen "
                    "from the session's folder)")
        ->type_name("DIR");
    command.add_flag("--json", options.json, "Print JSON");
    add_context_option(command, options.context);
    run_when_chosen(command, chosen, [given] { return run_replay(*given); });
}

} // namespace overt
