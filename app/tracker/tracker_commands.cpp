#include "app/tracker/tracker_commands.h"

#include "app/cli/command_options.h"
#include "app/cli/library_option.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {

namespace {

void add_further(CLI::App& command, std::string& further) {
    option(command, "--further", further, "FURTHER",
           "Id of the protocol's [[further_tracker]] that is meant");
}

void add_list(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_tracker_list, "list",
                    "The kinds of eye tracker, and what of them is found here", "overt tracker list");
    add_library_option(command);
    add_json_flag(command, options.json);
}

void add_test(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_tracker_test, "test",
        "Records for some seconds and says how fast the tracker samples, what it loses, how its clock runs",
        "overt tracker test --tracker opengaze --address 127.0.0.1:4242 --seconds 30");
    command.add_option("PROTOCOL", options.protocol, "Whose [tracker] is tested (default: a simulated one)");
    add_further(command, options.further);
    option(command, "--tracker", options.kind, "KIND",
           "Kind of eye tracker, instead of the protocol's [tracker] kind",
           one_of_names(names_of<TrackerKind>));
    option(command, "--address", options.address, "TEXT",
           "Where the tracker is, instead of [tracker] address");
    add_library_option(command);
    option(command, "--rate", options.rate_hz, "HZ", "Wished samples per second", CLI::Range(1.0, 10000.0));
    option(command, "--seconds", options.seconds, "S", "How long to record", seconds_up_to_an_hour(),
           shown_default);
    add_json_flag(command, options.json);
}

void add_calibrate(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_tracker_calibrate, "calibrate",
        "Calibrates and validates the tracker on the screen, as a session does, and says how well",
        "overt tracker calibrate protocols/overt_2019.toml --tracker mouse\n"
        "  overt tracker calibrate protocols/overt_2019.toml --by-overt --simulate-observer 1 --virtual-time "
        "--context osmesa --picture validation.png");
    command.add_option("PROTOCOL", options.protocol, "Whose screen and tracker")->required();
    add_further(command, options.further);
    add_library_option(command);
    option(command, "--tracker", options.kind, "KIND",
           "Kind of eye tracker, instead of the protocol's [tracker] kind",
           one_of_names(names_of<TrackerKind>));
    command.add_flag("--by-overt", options.by_overt,
                     "Calibrate by the program, as [calibration] by = \"overt\"");
    option(command, "--simulate-observer", options.simulate_observer, "SEED",
           "Let a simulated observer look");
    command.add_flag("--virtual-time", options.virtual_time,
                     "Run as fast as the machine can, on a clock of its own");
    add_screen_options(command, options.windowed, options.monitor, "the protocol's");
    option(command, "--picture", options.picture, "FILE.png",
           "Draw the validation: measured gaze beside the targets");
    add_context_option(command, options.context);
}

void add_show(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_tracker_show, "show",
                    "The calibrations of a session: accuracy and precision at each target",
                    "overt tracker show sessions/overt_2019/obs-1_session-1 --picture validation.png");
    command.add_option("SESSION", options.session, "Folder of a session, or one that holds a single one")
        ->required();
    option(command, "--picture", options.picture, "FILE.png",
           "Draw the last validation: measured gaze beside the targets");
    add_json_flag(command, options.json);
}

void add_fetch(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_tracker_fetch, "fetch",
        "Fetches the data files that sessions had to leave on an EyeLink's host into their folders",
        "overt tracker fetch");
    add_library_option(command);
}

} // namespace

void add_tracker_commands(CLI::App& app, ChosenCommand& chosen) {
    CLI::App& command =
        add_command(app, "tracker", "Eye trackers: what there is, how it samples, how it was calibrated",
                    "overt tracker list");
    command.require_subcommand(1);
    add_list(command, chosen);
    add_test(command, chosen);
    add_calibrate(command, chosen);
    add_show(command, chosen);
    add_fetch(command, chosen);
}

} // namespace overt
