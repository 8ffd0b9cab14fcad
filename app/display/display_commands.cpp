#include "app/display/display_commands.h"

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_characterise(CLI::App& display, ChosenCommand& chosen) {
    const auto given = std::make_shared<DisplayCharacteriseOptions>();
    DisplayCharacteriseOptions& options = *given;
    CLI::App& command =
        add_command(display, "characterise",
                    "Measures the display with a photometer, fits its light and curves, and proves them",
                    "overt display characterise protocols/overt_2019.toml --out lab3.toml --warm-up 30\n"
                    "  overt display characterise --readings lab3_readings.csv --out lab3.toml\n"
                    "  overt display characterise --simulated 1 --context osmesa --out simulated.toml");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML): its screen and output");
    command.add_option("--out", options.out, "File to write; readings and report go beside it")
        ->type_name("FILE.toml")
        ->capture_default_str();
    auto* readings = command
                         .add_option("--readings", options.readings,
                                     "Show nothing: take the readings of this table, with columns "
                                     "level_r,level_g,level_b (0 to 1),X,Y,Z")
                         ->type_name("FILE.csv");
    auto* typed = command.add_flag("--typed", options.typed,
                                   "Ask at the terminal for what an instrument shows, patch by patch");
    auto* simulated = command
                          .add_option("--simulated", options.simulated,
                                      "A simulated photometer before a simulated display: a rehearsal")
                          ->type_name("SEED");
    readings->excludes(typed)->excludes(simulated);
    typed->excludes(simulated);
    command.add_option("--port", options.port, "Serial port of the ColorCAL (default: the only one)")
        ->type_name("PORT")
        ->excludes(readings)
        ->excludes(typed)
        ->excludes(simulated);
    command.add_option("--name", options.name, "Which display it is, for the file")->capture_default_str();
    command.add_option("--instrument", options.instrument, "What the readings were taken with, in words");
    command.add_option("--mode", options.mode, "Output mode (default: the protocol's, else native-8bit)")
        ->check(CLI::IsMember(
            names_of_modes([](const OutputModeRow& row) { return row.shows == ShownLight::colours; })))
        ->type_name("MODE");
    command
        .add_option("--model", options.model,
                    "Curves of the file: the measured table, or the power that was fitted to it")
        ->check(CLI::IsMember({"table", "power"}))
        ->capture_default_str();
    command.add_option("--levels", options.levels, "Levels of each channel, black among them")
        ->check(CLI::Range(6, 256))
        ->capture_default_str();
    command.add_option("--mixed", options.mixed, "Random patches for validation")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command.add_option("--repeats", options.repeats, "Readings of each patch, each time in another order")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Of the order and the random patches")->capture_default_str();
    command.add_option("--settle", options.settle_s, "Time from a patch's onset to its reading")
        ->type_name("S")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    command.add_option("--warm-up", options.warm_up_min, "White before the first reading")
        ->type_name("MIN")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    command.add_option("--size", options.size_deg, "Side of the patch (default: the whole screen)")
        ->type_name("DEG")
        ->check(CLI::Range(0.1, 120.0));
    command.add_option("--surround", options.surround, "Signal around the patch, 0 to 1")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command
        .add_option("--crosstalk", options.crosstalk,
                    "By how much a channel of the simulated display sinks when the others are lit")
        ->check(CLI::Range(0.0, 0.5))
        ->needs(simulated);
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
    command
        .add_option(
            "--monitor", options.monitor,
            "The screen to take: its number as `overt doctor` lists them, or the name of its output or EDID")
        ->type_name("WHICH");
    add_context_option(command, options.context);
    command.add_flag("--force", options.force, "Replace files that are there");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_display_characterise(*given); });
}

void add_colour(CLI::App& display, ChosenCommand& chosen) {
    const auto given = std::make_shared<DisplayColourOptions>();
    DisplayColourOptions& options = *given;
    CLI::App& command =
        add_command(display, "colour",
                    "Which signal makes a colour on a characterised display, and which colour a light is",
                    "overt display colour lab3.toml --xyz 41.2 43.5 46.1\n"
                    "  overt display colour lab3.toml --spectra patches.csv --json");
    command.add_option("CHARACTERISATION", options.characterisation, "Characterisation file (TOML)")
        ->required();
    auto* colours = command.add_option_group("one colour, or a table of them");
    colours->add_option("--xyz", options.xyz, "XYZ in cd/m2")->expected(3)->type_name("X Y Z");
    colours->add_option("--cones", options.cones, "Cone excitations in W/(sr m2), CIE 2006, 2 degrees")
        ->expected(3)
        ->type_name("L M S");
    colours->add_option("--rgb", options.rgb, "Linear light of the display, 0 to 1")
        ->expected(3)
        ->type_name("R G B");
    colours
        ->add_option("--spectra", options.spectra,
                     "Radiances in W/(sr m2 nm): a column wavelength_nm, and one for each colour")
        ->type_name("FILE.csv");
    colours->require_option(1);
    command
        .add_option(
            "--observer", options.observer,
            "For whom --xyz and --spectra are matched; all but cie1931 need the spectra of the display")
        ->check(CLI::IsMember({"cie1931", "cie2006", "cie2006-cones"}))
        ->capture_default_str();
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_display_colour(*given); });
}

void add_status(CLI::App& display, ChosenCommand& chosen) {
    const auto given = std::make_shared<DisplayStatusOptions>();
    DisplayStatusOptions& options = *given;
    CLI::App& command = add_command(display, "status",
                                    "Which display box there is, what it says of itself, and whether a "
                                    "run that was killed left it switched",
                                    "overt display status\n"
                                    "  overt display status --port /dev/ttyACM0 --json");
    command.add_option("--port", options.port, "Ask at this serial port only")->type_name("PORT");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_display_status(*given); });
}

void add_mode(CLI::App& display, ChosenCommand& chosen) {
    const auto given = std::make_shared<DisplayModeOptions>();
    DisplayModeOptions& options = *given;
    CLI::App& command =
        add_command(display, "mode", "Switches the display box, and says what of it is proved",
                    "overt display mode bits++\n"
                    "  overt display mode color++ --port /dev/ttyACM0");
    command.add_option("MODE", options.mode, "bits++ (in which a desktop can be read), mono++ or color++")
        ->required()
        ->check(CLI::IsMember({"bits++", "mono++", "color++"}));
    command.add_option("--port", options.port, "Serial port of the box (default: look for it)")
        ->type_name("PORT");
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_display_mode(*given); });
}

/// Two commands by one name: what is drawn, and what arrives at the box.
struct VerifyOptions {
    DisplayVerifyOptions on_screen;
    DisplayHardwareOptions hardware;
    bool on_hardware = false;
};

void add_verify(CLI::App& display, ChosenCommand& chosen) {
    const auto given = std::make_shared<VerifyOptions>();
    CLI::App& command = add_command(
        display, "verify",
        "Draws all levels, random light, edges and stimuli, reads them back, decodes them, and counts what "
        "differs",
        "overt display verify\n"
        "  overt display verify protocols/overt_2019.toml --stimulus muse/smooth --mode color++");
    command.add_option("PROTOCOL", given->on_screen.protocol,
                       "Protocol file (TOML): its screen, and its stimuli as it sends them");
    command
        .add_option("--stimulus", given->on_screen.stimulus, "SCULPTURE/MATERIAL by their ids (default: all)")
        ->type_name("ID");
    command.add_option("--mode", given->on_screen.modes, "Output mode, as in a protocol (default: all)")
        ->check(CLI::IsMember(names_of_modes([](const OutputModeRow&) { return true; })))
        ->type_name("MODE");
    add_context_option(command, given->on_screen.context);
    command.add_flag("--json", given->on_screen.json, "Print JSON");
    auto& on_hardware_flag = *command.add_flag(
        "--hardware", given->on_hardware,
        "Draw known lines on the display instead, have its box send back what it received, three times, and "
        "say line by line what the way there changed");
    command.add_option("--port", given->hardware.port, "Serial port of the box (default: look for it)")
        ->needs(&on_hardware_flag)
        ->type_name("PORT");
    command
        .add_option("--monitor", given->hardware.monitor,
                    "The screen behind the box: its number as `overt doctor` lists them, or the name of its "
                    "output or "
                    "EDID (default: the only one)")
        ->needs(&on_hardware_flag)
        ->type_name("WHICH");
    for (const char* other : {"PROTOCOL", "--stimulus", "--mode", "--context"})
        on_hardware_flag.excludes(command.get_option(other));
    run_when_chosen(command, chosen, [given] {
        given->hardware.json = given->on_screen.json;
        return given->on_hardware ? run_display_hardware_check(given->hardware)
                                  : run_display_verify(given->on_screen);
    });
}

void add_doctor(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<DoctorOptions>();
    DoctorOptions& options = *given;
    CLI::App& command =
        add_command(app, "doctor", "What this machine offers for a session, and what is missing",
                    "overt doctor --json\n"
                    "  overt doctor --photodiode --protocol protocols/overt_2019.toml --sensor simulated "
                    "--context osmesa\n"
                    "  overt doctor --window --monitor 1 --seconds 30 --report rig.md");
    command.add_flag("--json", options.json, "Print JSON");
    command.add_flag("--window", options.window,
                     "Show a dark screen, measure its refreshes, and say what may spoil their times");
    command.add_flag("--photodiode", options.photodiode,
                     "Show a square in a corner that changes, and compare what a sensor sees with the times "
                     "of the flips");
    command
        .add_option("--protocol", options.protocol,
                    "Show the square as a session of this protocol would: its screen, mode, display box and "
                    "corner")
        ->type_name("FILE");
    command
        .add_option(
            "--sensor", options.sensor,
            "Serial port of a light sensor that sends 1 and 0, or `simulated` (5 ms late, 0.2 ms jitter)")
        ->type_name("PORT");
    command
        .add_option(
            "--report", options.report,
            "Write all that is found as a page to keep, with what --window and --photodiode measure and "
            "pictures of it")
        ->type_name("FILE.md");
    add_context_option(command, options.context);
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
    command
        .add_option(
            "--monitor", options.monitor,
            "The screen to take: its number as this command lists them, or the name of its output or EDID")
        ->type_name("WHICH");
    command.add_option("--seconds", options.seconds, "How long to measure")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    run_when_chosen(command, chosen, [given] { return run_doctor(*given); });
}

} // namespace

void add_display_commands(CLI::App& app, ChosenCommand& chosen) {
    CLI::App& display =
        add_command(app, "display", "The way to the display", "overt display verify --context osmesa");
    display.require_subcommand(1);
    add_verify(display, chosen);
    add_status(display, chosen);
    add_mode(display, chosen);
    add_characterise(display, chosen);
    add_colour(display, chosen);
    add_doctor(app, chosen);
}

} // namespace overt
