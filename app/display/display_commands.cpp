#include "app/display/display_commands.h"

#include "app/cli/command_options.h"

namespace overt {

namespace {

void add_characterise(CLI::App& display, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        display, chosen, run_display_characterise, "characterise",
        "Measures the display with a photometer, fits its light and curves, and proves them",
        "overt display characterise protocols/overt_2019.toml --out lab3.toml --warm-up 30\n"
        "  overt display characterise --readings lab3_readings.csv --out lab3.toml\n"
        "  overt display characterise --simulate-photometer 1 --context osmesa --out simulated.toml");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML): its screen and output");
    option(command, "--out", options.out, "FILE.toml", "File to write; readings and report go beside it",
           shown_default);
    CLI::Option* const readings = option(
        command, "--readings", options.readings, "FILE.csv",
        "Show nothing: take the readings of this table, with columns level_r,level_g,level_b (0 to 1),X,Y,Z");
    auto* typed = command.add_flag("--typed", options.typed,
                                   "Ask at the terminal for what an instrument shows, patch by patch");
    CLI::Option* const simulated =
        option(command, "--simulate-photometer", options.simulated, "SEED",
               "A simulated photometer before a simulated display: to learn the procedure");
    readings->excludes(typed)->excludes(simulated);
    typed->excludes(simulated);
    option(command, "--port", options.port, "PORT", "Serial port of the ColorCAL (default: the only one)")
        ->excludes(readings)
        ->excludes(typed)
        ->excludes(simulated);
    option(command, "--name", options.name, "", "Which display it is, for the file", shown_default);
    option(command, "--instrument", options.instrument, "", "What the readings were taken with, in words");
    option(command, "--mode", options.mode, "MODE", "Output mode (default: the protocol's, else native-8bit)",
           one_of(names_of_modes([](const OutputModeRow& row) { return row.shows == ShownLight::colours; })));
    option(command, "--model", options.model, "",
           "Curves of the file: the measured table, or the power that was fitted to it",
           one_of({"table", "power"}), shown_default);
    option(command, "--levels", options.levels, "", "Levels of each channel, black among them",
           CLI::Range(6, 256), shown_default);
    option(command, "--mixed", options.mixed, "", "Random patches for validation", CLI::Range(0, 1000),
           shown_default);
    option(command, "--repeats", options.repeats, "", "Readings of each patch, each time in another order",
           CLI::Range(1, 100), shown_default);
    option(command, "--seed", options.seed, "SEED", "Of the order and the random patches", shown_default);
    option(command, "--settle", options.settle_s, "S", "Time from a patch's onset to its reading",
           CLI::Range(0.0, 600.0), shown_default);
    option(command, "--warm-up", options.warm_up_min, "MIN", "White before the first reading",
           CLI::Range(0.0, 600.0), shown_default);
    option(command, "--size", options.size_deg, "DEG", "Side of the patch (default: the whole screen)",
           CLI::Range(0.1, 120.0));
    option(command, "--surround", options.surround, "", "Signal around the patch, 0 to 1",
           CLI::Range(0.0, 1.0), shown_default);
    option(command, "--crosstalk", options.crosstalk, "",
           "By how much a channel of the simulated display sinks when the others are lit",
           CLI::Range(0.0, 0.5))
        ->needs(simulated);
    add_screen_options(command, options.windowed, options.monitor, "the protocol's, or the only one");
    add_context_option(command, options.context);
    command.add_flag("--overwrite", options.force, "Replace files that are there");
    add_json_flag(command, options.json);
}

void add_colour(CLI::App& display, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(display, chosen, run_display_colour, "colour",
                    "Which signal makes a colour on a characterised display, and which colour a light is",
                    "overt display colour lab3.toml --xyz 41.2 43.5 46.1\n"
                    "  overt display colour lab3.toml --spectra patches.csv --json");
    command.add_option("CHARACTERISATION", options.characterisation, "Characterisation file (TOML)")
        ->required();
    CLI::App& colours = *command.add_option_group("one colour, or a table of them");
    option(colours, "--xyz", options.xyz, "X Y Z", "XYZ in cd/m2")->expected(3);
    option(colours, "--cones", options.cones, "L M S", "Cone excitations in W/(sr m2), CIE 2006, 2 degrees")
        ->expected(3);
    option(colours, "--rgb", options.rgb, "R G B", "Linear light of the display, 0 to 1")->expected(3);
    option(colours, "--spectra", options.spectra, "FILE.csv",
           "Radiances in W/(sr m2 nm): a column wavelength_nm, and one for each colour");
    colours.require_option(1);
    option(command, "--standard-observer", options.observer, "",
           "For whom --xyz and --spectra are matched; all but cie1931 need the spectra of the display",
           one_of({"cie1931", "cie2006", "cie2006-cones"}), shown_default);
    add_json_flag(command, options.json);
}

void add_status(CLI::App& display, ChosenCommand& chosen) {
    const auto [command, options] = add_command(display, chosen, run_display_status, "status",
                                                "Which display box there is, what it says of itself, and "
                                                "whether a run that was killed left it switched",
                                                "overt display status\n"
                                                "  overt display status --port /dev/ttyACM0 --json");
    option(command, "--port", options.port, "PORT", "Ask at this serial port only");
    add_json_flag(command, options.json);
}

void add_mode(CLI::App& display, ChosenCommand& chosen) {
    const auto [command, options] = add_command(display, chosen, run_display_mode, "mode",
                                                "Switches the display box, and says what of it is proved",
                                                "overt display mode bits++\n"
                                                "  overt display mode color++ --port /dev/ttyACM0");
    command.add_option("MODE", options.mode, "bits++ (in which a desktop can be read), mono++ or color++")
        ->required()
        ->check(one_of({"bits++", "mono++", "color++"}));
    option(command, "--port", options.port, "PORT", "Serial port of the box (default: look for it)");
    add_json_flag(command, options.json);
}

void add_stereo(CLI::App& display, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        display, chosen, run_display_stereo, "stereo",
        "Shows both eyes a cross, a frame and half a line each, and lets the arrows move the pictures "
        "until they lie on each other: for setting up a stereoscope",
        "overt display stereo my_study.toml\n"
        "  overt display stereo my_study.toml --picture fields.png");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML) with [stereo]")->required();
    option(command, "--picture", options.picture, "FILE.png", "Write the screen instead of showing it");
    add_monitor_option(command, options.monitor, "the protocol's");
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
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
    option(command, "--stimulus", given->on_screen.stimulus, "STIMULUS",
           "OBJECT/MATERIAL by their ids (default: all)");
    option(command, "--mode", given->on_screen.modes, "MODE", "Output mode, as in a protocol (default: all)",
           one_of(names_of_modes([](const OutputModeRow&) { return true; })));
    add_context_option(command, given->on_screen.context);
    add_json_flag(command, given->on_screen.json);
    auto& on_hardware_flag = *command.add_flag(
        "--hardware", given->on_hardware,
        "Draw known lines on the display instead, have its box send back what it received, three times, and "
        "say line by line what the way there changed");
    option(command, "--port", given->hardware.port, "PORT", "Serial port of the box (default: look for it)")
        ->needs(&on_hardware_flag);
    add_monitor_option(command, given->hardware.monitor, "the only one")->needs(&on_hardware_flag);
    for (const char* other : {"PROTOCOL", "--stimulus", "--mode", "--context"})
        on_hardware_flag.excludes(command.get_option(other));
    run_when_chosen(command, chosen, [given] {
        given->hardware.json = given->on_screen.json;
        return given->on_hardware ? run_display_hardware_check(given->hardware)
                                  : run_display_verify(given->on_screen);
    });
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
    add_stereo(display, chosen);
}

} // namespace overt
