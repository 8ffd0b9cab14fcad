#include "app/tracker/tracker_commands.h"

#include "app/cli/command_options.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {

namespace {

void add_further(CLI::App& command, std::string& further) {
    command.add_option("--further", further, "Id of the protocol's [[further_tracker]] that is meant")
        ->type_name("ID");
}

void add_list(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<TrackerListOptions>();
    CLI::App& command = add_command(app, "list", "The kinds of eye tracker, and what of them is found here",
                                    "overt tracker list");
    command.add_flag("--json", given->json, "Print as JSON");
    run_when_chosen(command, chosen, [given] { return run_tracker_list(*given); });
}

void add_test(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<TrackerTestOptions>();
    TrackerTestOptions& options = *given;
    CLI::App& command = add_command(
        app, "test",
        "Records for some seconds and says how fast the tracker samples, what it loses, how its clock runs",
        "overt tracker test --tracker opengaze --address 127.0.0.1:4242 --seconds 30");
    command.add_option("PROTOCOL", options.protocol, "Whose [tracker] is tested (default: a simulated one)");
    add_further(command, options.further);
    command.add_option("--tracker", options.kind, "Kind of eye tracker, instead of the protocol's")
        ->check(CLI::IsMember(
            std::vector<std::string>(names_of<TrackerKind>.begin(), names_of<TrackerKind>.end())));
    command.add_option("--address", options.address, "Where it is, as [tracker] address")->type_name("TEXT");
    command.add_option("--library", options.library, "Of its maker, as [tracker] library")->type_name("FILE");
    command.add_option("--rate", options.rate_hz, "Wished samples per second")
        ->type_name("HZ")
        ->check(CLI::Range(1.0, 10000.0));
    command.add_option("--seconds", options.seconds, "How long to record")
        ->type_name("S")
        ->check(seconds_up_to_an_hour())
        ->capture_default_str();
    command.add_flag("--json", options.json, "Print as JSON");
    run_when_chosen(command, chosen, [given] { return run_tracker_test(*given); });
}

void add_calibrate(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<TrackerCalibrateOptions>();
    TrackerCalibrateOptions& options = *given;
    CLI::App& command = add_command(
        app, "calibrate",
        "Calibrates and validates the tracker on the screen, as a session does, and says how well",
        "overt tracker calibrate protocols/overt_2019.toml --tracker mouse\n"
        "  overt tracker calibrate protocols/overt_2019.toml --by-overt --simulate-observer 1 --virtual-time "
        "--context osmesa --picture validation.png");
    command.add_option("PROTOCOL", options.protocol, "Whose screen and tracker")->required();
    add_further(command, options.further);
    command.add_option("--tracker", options.kind, "Kind of eye tracker, instead of the protocol's")
        ->check(CLI::IsMember(
            std::vector<std::string>(names_of<TrackerKind>.begin(), names_of<TrackerKind>.end())));
    command.add_flag("--by-overt", options.by_overt,
                     "Calibrate by the program, as [calibration] by = \"overt\"");
    command.add_option("--simulate-observer", options.simulate_observer, "Let a simulated observer look")
        ->type_name("SEED");
    command.add_flag("--virtual-time", options.virtual_time,
                     "Run as fast as the machine can, on a clock of its own");
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
    command
        .add_option(
            "--monitor", options.monitor,
            "The screen to take: its number as `overt doctor` lists them, or the name of its output or EDID")
        ->type_name("WHICH");
    command.add_option("--picture", options.picture, "Draw the validation: measured gaze beside the targets")
        ->type_name("FILE.png");
    add_context_option(command, options.context);
    run_when_chosen(command, chosen, [given] { return run_tracker_calibrate(*given); });
}

void add_show(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<TrackerShowOptions>();
    CLI::App& command =
        add_command(app, "show", "The calibrations of a session: accuracy and precision at each target",
                    "overt tracker show sessions/overt_2019/obs-1_session-1 --picture validation.png");
    command.add_option("SESSION", given->session, "Folder of a session")->required();
    command
        .add_option("--picture", given->picture, "Draw the last validation: measured gaze beside the targets")
        ->type_name("FILE.png");
    command.add_flag("--json", given->json, "Print as JSON");
    run_when_chosen(command, chosen, [given] { return run_tracker_show(*given); });
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
}

} // namespace overt
