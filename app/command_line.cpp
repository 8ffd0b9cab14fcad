#include "app/command_line.h"

#include <functional>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/commands.h"
#include "build_info.h"

namespace overt {

namespace {

const char* const synopsis =
    "Eye-tracking experiments on animated 3D objects, from a protocol file to points on the surface.";

const char* const exit_codes =
    "Exit codes: 0 done, 1 failed, 2 bad input.\n"
    "Frames, maps and sculptures are kept in $OVERT_CACHE (default: ~/.cache/overt).";

const std::map<std::string, ContextChoice> context_names{{"auto", std::nullopt},
                                                         {"window", ContextKind::window},
                                                         {"egl", ContextKind::egl},
                                                         {"osmesa", ContextKind::osmesa}};

const std::map<std::string, MapTime> map_times{
    {"auto", MapTime::automatic}, {"live", MapTime::live}, {"prepared", MapTime::prepared}};

const std::map<std::string, BakeQuality> qualities{{"live", BakeQuality::live},
                                                   {"preview", BakeQuality::preview},
                                                   {"draft", BakeQuality::draft},
                                                   {"standard", BakeQuality::standard},
                                                   {"reference", BakeQuality::reference}};

CLI::Option* add_quality_option(CLI::App& command, std::optional<BakeQuality>& quality, const std::string& what,
                                const std::vector<std::string>& names) {
    return command
        .add_option_function<std::string>(
            "--quality", [&quality](const std::string& name) { quality = qualities.at(name); }, what)
        ->check(CLI::IsMember(names))
        ->type_name("QUALITY");
}

void add_context_option(CLI::App& command, ContextChoice& context) {
    command
        .add_option_function<std::string>(
            "--context", [&context](const std::string& name) { context = context_names.at(name); },
            "OpenGL through auto (a window where there is a display, else EGL with a graphics processor, "
            "else OSMesa), window, egl or osmesa")
        ->check(CLI::IsMember({"auto", "window", "egl", "osmesa"}))
        ->type_name("KIND");
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& what,
                      const std::string& example) {
    CLI::App& command = *app.add_subcommand(name, what);
    command.footer("Example:\n  " + example + "\n");
    return command;
}

void add_bake_command(CLI::App& app, BakeOptions& options, std::function<void()> chosen) {
    CLI::App& command = add_command(
        app, "bake", "Renders the stimuli by spectral path tracing, and keeps each frame",
        "overt bake protocols/overt_2019.toml --quality standard\n"
        "  overt bake protocols/overt_2019.toml --only muse/rough --frames 0-30 --out frames --as spectra\n"
        "  overt bake protocols/overt_2019.toml --shard 3/16");
    command.add_option("PROTOCOL", options.protocol, "Protocol file (TOML)")->required();
    add_quality_option(command, options.quality,
                       "preview, draft, standard or reference (default: the protocol's, or standard if it asks "
                       "for no more than a preview)",
                       {"preview", "draft", "standard", "reference"});
    command.add_option("--samples", options.samples, "Light paths through each pixel, instead of the usual")
        ->type_name("N")
        ->check(CLI::Range(1, 65536));
    command
        .add_option("--target-error", options.target_error_de,
                    "Leave a pixel when its standard error is below this colour difference")
        ->type_name("DE")
        ->check(CLI::Range(0.01, 100.0));
    command
        .add_option("--only", options.only,
                    "This stimulus, SCULPTURE/MATERIAL by their ids; may be given several times")
        ->type_name("ID");
    command.add_option("--frames", options.frames, "Frames of the animation: K, A-B or all")
        ->type_name("RANGE")
        ->capture_default_str();
    command
        .add_option("--shard", options.shard,
                    "The part of machine I of N, I from 1; they share the cache, or join their caches later")
        ->type_name("I/N");
    command
        .add_option("--out", options.out,
                    "Also write numbered frames: DIR/SCULPTURE_MATERIAL/frame_0000.exr, half floats")
        ->type_name("DIR");
    command
        .add_option("--as", options.as,
                    "What is in those files: the display's linear light, XYZ, or 31 bins of radiance")
        ->check(CLI::IsMember({"display", "xyz", "spectra"}))
        ->capture_default_str();
    command.add_flag("--png16", options.png16,
                     "16-bit PNG of linear display light over the background, clipped, each with a JSON file, "
                     "instead of EXR");
    command.add_flag("--force", options.force, "Replace files that are there and were made otherwise");
    command.add_option("--sheet", options.sheet, "Also write a picture of all stimuli side by side")
        ->type_name("FILE.png");
    command.add_option("--strip", options.strip, "Also write a picture of frames of one stimulus side by side")
        ->type_name("FILE.png");
    command.add_flag("--dry-run", options.dry_run, "Only say what is to be done and how long it will take");
    add_context_option(command, options.context);
    command.add_flag("--json", options.json, "Print JSON");
    command.callback(std::move(chosen));
}

void add_characterise_command(CLI::App& display, DisplayCharacteriseOptions& options,
                              std::function<void()> chosen) {
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
        ->check(CLI::IsMember({"native-8bit", "native-10bit", "color++", "vpixx-c48"}))
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
    command.add_option("--monitor", options.monitor, "The screen to take, as `overt doctor` numbers them")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    add_context_option(command, options.context);
    command.add_flag("--force", options.force, "Replace files that are there");
    command.add_flag("--json", options.json, "Print JSON");
    command.callback(std::move(chosen));
}

void add_colour_command(CLI::App& display, DisplayColourOptions& options, std::function<void()> chosen) {
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
    command.callback(std::move(chosen));
}

} // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app(synopsis, "overt");
    app.set_version_flag("--version", std::string("overt ") + build::version);
    app.require_subcommand(1);
    app.footer(exit_codes);
    app.get_formatter()->column_width(34);
    std::function<int()> command;

    CheckOptions check;
    auto& check_command =
        add_command(app, "check", "Everything that can be known before an observer sits down",
                    "overt check protocols/overt_2019.toml --observer 07");
    check_command.add_option("PROTOCOL", check.protocol, "Protocol file (TOML)")->required();
    check_command.add_option("--observer", check.observer, "Show this observer's order of trials")
        ->type_name("ID");
    check_command.add_flag("--all-observers", check.all_observers, "Show the order of each planned observer");
    check_command
        .add_option("--answer-time", check.answer_time_s,
                    "Seconds an answer is taken to last, for the session's length")
        ->type_name("S")
        ->capture_default_str();
    check_command
        .add_option("--seed", check.seed, "Show the orders that this seed gives, as the record of a session has it")
        ->type_name("SEED");
    check_command.add_flag("--frames", check.frames,
                           "Read every frame, and say how much of its light the display cannot show");
    check_command.add_flag("--json", check.json, "Print JSON");
    check_command.callback([&] { command = [&] { return run_check(check); }; });

    RunOptions run;
    auto& run_command = add_command(app, "run", "Runs a session",
                                    "overt run protocols/overt_2019.toml --observer 07\n"
                                    "  overt run protocols/overt_2019.toml --observer 07 --simulate-observer "
                                    "1 --virtual-time --context osmesa");
    run_command.add_option("PROTOCOL", run.protocol, "Protocol file (TOML)")->required();
    run_command
        .add_option(
            "--observer", run.observer,
            "Who sits there: letters, digits and hyphens; the digits at the end are the observer's number")
        ->required()
        ->type_name("ID");
    run_command
        .add_option("--session", run.session_number, "Number of this sitting (default: the next free one)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    run_command
        .add_option("--seed", run.seed,
                    "Seed of the order and of all that is simulated (default: the protocol's, or a new one)")
        ->type_name("N");
    run_command
        .add_option("--simulate-observer", run.simulate_observer, "Let a simulated observer look and answer")
        ->type_name("SEED");
    run_command.add_flag("--virtual-time", run.virtual_time,
                         "Run as fast as the machine can, on a clock of its own");
    run_command.add_flag("--windowed", run.windowed, "A window instead of the whole screen");
    run_command
        .add_option("--monitor", run.monitor,
                    "The screen to take, as `overt doctor` numbers them (default: the first that has the "
                    "protocol's resolution)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    run_command.add_option("--sessions", run.sessions, "Folder for sessions")
        ->type_name("DIR")
        ->capture_default_str();
    run_command.add_option("--trials", run.trials, "Only the first N trials, for a rehearsal")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    run_command
        .add_option("--print-session-to", run.print_session_to,
                    "Write the session's path to this file, for scripts")
        ->type_name("FILE");
    run_command
        .add_option_function<std::string>(
            "--maps", [&run](const std::string& time) { run.maps = map_times.at(time); },
            "Draw the hidden maps live while their frames are shown, or prepared before (auto: live on a "
            "graphics processor)")
        ->check(CLI::IsMember({"auto", "live", "prepared"}))
        ->type_name("WHEN");
    run_command.add_flag("--verify-output", run.verify_output,
                         "Decode every page before the first trial, compare it with its prediction, and "
                         "record the result with the hash of what is sent");
    run_command
        .add_option(
            "--faults", run.faults,
            "Rehearse on a display that does wrong what this file (TOML) says: late pictures, skipped "
            "refreshes, stalls, jitter and drift of time stamps")
        ->type_name("FILE");
    run_command.add_flag("--realtime", run.realtime,
                         "Ask for real-time priority and locked memory; goes on if they are refused");
    run_command.add_option("--pin", run.processor, "Run the session's thread on this processor only")
        ->type_name("CPU")
        ->check(CLI::NonNegativeNumber);
    run_command
        .add_option("--refresh-check", run.refresh_check_s,
                    "How long the refresh of a real screen is measured before the session; less for a "
                    "rehearsal, 0 not at all")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    add_quality_option(run_command, run.quality,
                       "What the stimuli have at least, instead of what the protocol asks for",
                       {"live", "preview", "draft", "standard", "reference"});
    add_context_option(run_command, run.context);
    run_command.callback([&] { command = [&] { return run_session(run); }; });

    PlayOptions play;
    auto& play_command = add_command(
        app, "play", "Shows one animation, or one of its frames as a picture",
        "overt play protocols/overt_2019.toml --stimulus muse/smooth --frame 15 --picture frame.png");
    play_command.add_option("PROTOCOL", play.protocol, "Protocol file (TOML)")->required();
    play_command.add_option("--stimulus", play.stimulus, "SCULPTURE/MATERIAL by their ids")
        ->required()
        ->type_name("ID");
    play_command.add_option("--frame", play.frame, "Animation frame for --picture (default: 0)")
        ->type_name("K")
        ->check(CLI::NonNegativeNumber);
    play_command.add_option("--picture", play.picture, "Write a PNG instead of opening a window")
        ->type_name("FILE");
    play_command.add_option("--duration", play.repeat_s, "How long to play")
        ->type_name("S")
        ->capture_default_str();
    play_command.add_flag(
        "--live", play.live,
        "Draw it now, as an approximation, to be turned with the mouse: drag to turn and tilt, "
        "wheel to go nearer, left and right for the material, up and down for the sculpture, "
        "space for the animation, Escape to end");
    add_context_option(play_command, play.context);
    play_command.callback([&] { command = [&] { return run_play(play); }; });

    BakeOptions bake;
    add_bake_command(app, bake, [&] { command = [&] { return run_bake(bake); }; });

    ExportOptions exporting;
    auto& export_command =
        add_command(app, "export", "Writes sessions as tables for other tools",
                    "overt export sessions/overt_2019/sub-07_ses-01 --format tsv --out tables");
    export_command.add_option("SESSION", exporting.sessions, "Folders of sessions")->required();
    export_command.add_option("--format", exporting.format, "tsv: tables with a dictionary of their columns")
        ->check(CLI::IsMember({"tsv"}))
        ->capture_default_str();
    export_command
        .add_option("--out", exporting.out,
                    "Folder to write to (default: export_tsv in the session; for several sessions a folder "
                    "each is made in it)")
        ->type_name("DIR");
    export_command
        .add_option("--cone-deg", exporting.cone_deg,
                    "Add the probability that the gaze was on the sculpture, and on each of its parts, for a "
                    "tracker that is so far off on average (a usual accuracy: 0.5)")
        ->type_name("DEG")
        ->check(CLI::Range(0.0, 20.0));
    export_command.add_flag("--overwrite", exporting.overwrite, "Replace an export that is there");
    export_command.callback([&] { command = [&] { return run_export(exporting); }; });

    ShowOptions show;
    auto& show_command =
        add_command(app, "show", "What a session holds, and one trial as a picture",
                    "overt show sessions/overt_2019/sub-07_ses-01 --trial 3 --picture trial.png");
    show_command.add_option("SESSION", show.session, "Folder of a session")->required();
    show_command
        .add_option("--trial", show.trial, "Trial for --picture, counted from 1 (default: the first)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    show_command
        .add_option("--picture", show.picture, "Write a PNG: a frame, its map, and the gaze on the surface")
        ->type_name("FILE");
    show_command
        .add_option("--plot", show.plot,
                    "Write an SVG of the presentations' timing: intervals of refreshes, trial by trial")
        ->type_name("FILE");
    show_command.add_flag("--order", show.order,
                          "The planned order of trials, made again from the recorded protocol and seed; exit code 1 "
                          "if that gives another");
    show_command.add_flag("--json", show.json, "Print JSON");
    show_command.callback([&] { command = [&] { return run_show(show); }; });

    NewOptions fresh;
    auto& new_command = add_command(app, "new", "Writes a protocol to begin with, every key explained",
                                    "overt new my_experiment.toml");
    new_command.add_option("PROTOCOL", fresh.protocol, "File to write (TOML)")->required();
    new_command.callback([&] { command = [&] { return run_new(fresh); }; });

    auto& schema_command =
        add_command(app, "schema", "Prints the JSON Schema of protocol files, for editors",
                    "overt schema > protocol.schema.json");
    schema_command.callback([&] { command = [] { return run_schema(); }; });

    DoctorOptions doctor;
    auto& doctor_command =
        add_command(app, "doctor", "What this machine offers for a session", "overt doctor --json");
    doctor_command.add_flag("--json", doctor.json, "Print JSON");
    doctor_command.add_flag("--window", doctor.window,
                            "Show a dark screen, measure its refreshes, and say what may spoil their times");
    doctor_command.add_flag(
        "--photodiode", doctor.photodiode,
        "Show a square in the top left corner that changes, and compare what a sensor sees "
        "with the times of the flips");
    doctor_command
        .add_option(
            "--sensor", doctor.sensor,
            "Serial port of a light sensor that sends 1 and 0, or `simulated` (5 ms late, 0.2 ms jitter)")
        ->type_name("PORT");
    add_context_option(doctor_command, doctor.context);
    doctor_command.add_flag("--windowed", doctor.windowed, "A window instead of the whole screen");
    doctor_command
        .add_option("--monitor", doctor.monitor, "The screen to take, as this command numbers them")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    doctor_command.add_option("--seconds", doctor.seconds, "How long to measure")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    doctor_command.callback([&] { command = [&] { return run_doctor(doctor); }; });

    LutOptions lut;
    auto& lut_command = add_command(
        app, "lut", "Writes or checks coordinate-encoded maps: where on the surface each pixel lies",
        "overt lut protocols/overt_2019.toml --stimulus muse --frame 15 --out maps\n"
        "  overt lut protocols/overt_2019.toml --stimulus muse --frame all --check");
    lut_command.add_option("PROTOCOL", lut.protocol, "Protocol file (TOML)")->required();
    lut_command
        .add_option("--stimulus", lut.stimulus,
                    "SCULPTURE or SCULPTURE/MATERIAL by their ids; the map is the same for all materials")
        ->required()
        ->type_name("ID");
    lut_command
        .add_option_function<std::string>(
            "--frame",
            [&lut](const std::string& frame) {
                if (frame != "all")
                    lut.frame = std::stoi(frame);
            },
            "Animation frame, or all")
        ->required()
        ->check(CLI::IsMember({"all"}) | CLI::Range(0, 9999))
        ->type_name("K|all");
    lut_command
        .add_option("--out", lut.out,
                    "Folder to write to (default: luts/SCULPTURE; with --check nothing is written)")
        ->type_name("DIR");
    lut_command
        .add_option("--format", lut.format,
                    "exr: coordinates as floats; png16: 16-bit codes as colours, with a JSON sidecar; both")
        ->check(CLI::IsMember({"exr", "png16", "both"}))
        ->capture_default_str();
    lut_command.add_option("--scale", lut.scale, "Factor of 16-bit codes: 65535, or 65536 as in the paper")
        ->check(CLI::IsMember({65535, 65536}))
        ->capture_default_str();
    lut_command.add_flag("--check", lut.check,
                         "Compare with ray casting in double precision; exit code 1 if a target is missed");
    lut_command.add_flag("--overwrite", lut.overwrite, "Replace maps that are there");
    add_context_option(lut_command, lut.context);
    lut_command.add_flag("--json", lut.json, "Print JSON");
    lut_command.callback([&] { command = [&] { return run_lut(lut); }; });

    ReconstructOptions reconstruct;
    auto& reconstruct_command = add_command(
        app, "reconstruct",
        "Writes what the maps show of the object: a surface of one frame, or a cloud of all",
        "overt reconstruct protocols/overt_2019.toml --stimulus muse --frame 15 --out muse_15.ply\n"
        "  overt reconstruct protocols/overt_2019.toml --stimulus muse --frame all --out muse_cloud.ply");
    reconstruct_command.add_option("PROTOCOL", reconstruct.protocol, "Protocol file (TOML)")->required();
    reconstruct_command
        .add_option("--stimulus", reconstruct.stimulus,
                    "SCULPTURE or SCULPTURE/MATERIAL by their ids; the maps are the same for all materials")
        ->required()
        ->type_name("ID");
    reconstruct_command
        .add_option_function<std::string>(
            "--frame",
            [&reconstruct](const std::string& frame) {
                if (frame != "all")
                    reconstruct.frame = std::stoi(frame);
            },
            "Animation frame: the triangles between its pixels, cut at silhouettes and where one part hides "
            "another; or all: a cloud of the points that any frame shows")
        ->required()
        ->check(CLI::IsMember({"all"}) | CLI::Range(0, 9999))
        ->type_name("K|all");
    reconstruct_command.add_flag("--points", reconstruct.points, "A cloud of points also of one frame");
    reconstruct_command
        .add_option(
            "--spacing", reconstruct.spacing,
            "Keep one point in each cube of this size, in the unit of the mesh (default: the distance "
            "of neighbouring pixels)")
        ->type_name("SIZE")
        ->check(CLI::NonNegativeNumber);
    reconstruct_command.add_option("--out", reconstruct.out, "File to write: .ply or .obj")
        ->required()
        ->type_name("FILE");
    reconstruct_command.add_flag("--overwrite", reconstruct.overwrite, "Replace a file that is there");
    add_context_option(reconstruct_command, reconstruct.context);
    reconstruct_command.add_flag("--json", reconstruct.json, "Print JSON");
    reconstruct_command.callback([&] { command = [&] { return run_reconstruct(reconstruct); }; });

    auto& display_command =
        add_command(app, "display", "The way to the display", "overt display verify --context osmesa");
    display_command.require_subcommand(1);
    DisplayVerifyOptions verify;
    auto& verify_command = add_command(
        display_command, "verify",
        "Draws all levels, random light, edges and stimuli, reads them back, decodes them, and counts what "
        "differs",
        "overt display verify\n"
        "  overt display verify protocols/overt_2019.toml --stimulus muse/smooth --mode color++");
    verify_command.add_option("PROTOCOL", verify.protocol,
                              "Protocol file (TOML): its screen, and its stimuli as it sends them");
    verify_command
        .add_option("--stimulus", verify.stimulus, "SCULPTURE/MATERIAL by their ids (default: all)")
        ->type_name("ID");
    verify_command.add_option("--mode", verify.modes, "Output mode, as in a protocol (default: all)")
        ->check(CLI::IsMember(
            {"native-8bit", "native-10bit", "mono++", "color++", "bits++", "vpixx-m16", "vpixx-c48"}))
        ->type_name("MODE");
    add_context_option(verify_command, verify.context);
    verify_command.add_flag("--json", verify.json, "Print JSON");
    bool on_hardware = false;
    DisplayHardwareOptions hardware;
    auto& on_hardware_flag = *verify_command.add_flag(
        "--hardware", on_hardware,
        "Draw known lines on the display instead, have its box send back what it received, three times, and "
        "say line by line what the way there changed");
    verify_command.add_option("--port", hardware.port, "Serial port of the box (default: look for it)")
        ->needs(&on_hardware_flag)
        ->type_name("PORT");
    verify_command
        .add_option("--monitor", hardware.monitor,
                    "The screen behind the box, as `overt doctor` numbers them (default: 1)")
        ->needs(&on_hardware_flag)
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    for (const char* other : {"PROTOCOL", "--stimulus", "--mode", "--context"})
        on_hardware_flag.excludes(verify_command.get_option(other));
    verify_command.callback([&] {
        hardware.json = verify.json;
        command = [&] {
            return on_hardware ? run_display_hardware_check(hardware) : run_display_verify(verify);
        };
    });

    DisplayStatusOptions status;
    auto& status_command = add_command(display_command, "status",
                                       "Which display box there is, what it says of itself, and whether a "
                                       "run that was killed left it switched",
                                       "overt display status\n"
                                       "  overt display status --port /dev/ttyACM0 --json");
    status_command.add_option("--port", status.port, "Ask at this serial port only")->type_name("PORT");
    status_command.add_flag("--json", status.json, "Print JSON");
    status_command.callback([&] { command = [&] { return run_display_status(status); }; });

    DisplayModeOptions mode;
    auto& mode_command =
        add_command(display_command, "mode", "Switches the display box, and says what of it is proved",
                    "overt display mode bits++\n"
                    "  overt display mode color++ --port /dev/ttyACM0");
    mode_command.add_option("MODE", mode.mode, "bits++ (in which a desktop can be read), mono++ or color++")
        ->required()
        ->check(CLI::IsMember({"bits++", "mono++", "color++"}));
    mode_command.add_option("--port", mode.port, "Serial port of the box (default: look for it)")
        ->type_name("PORT");
    mode_command.add_flag("--json", mode.json, "Print JSON");
    mode_command.callback([&] { command = [&] { return run_display_mode(mode); }; });

    DisplayCharacteriseOptions characterise;
    add_characterise_command(display_command, characterise,
                             [&] { command = [&] { return run_display_characterise(characterise); }; });

    DisplayColourOptions colour;
    add_colour_command(display_command, colour,
                       [&] { command = [&] { return run_display_colour(colour); }; });

    BenchOptions bench;
    auto& bench_command = add_command(app, "bench", "The program's own benchmarks",
                                      "overt bench lut --json\n"
                                      "  overt bench lut --mesh statue.ply --up y");
    bench_command
        .add_option(
            "WHICH", bench.what,
            "lut: the hidden pass, its exactness, time and memory; reproject: gaze to "
            "surface, its exactness, speed and memory; present: a flip of a page, its time, processor "
            "time, packing and memory, and the timing of presentations on displays whose faults are known; "
            "frames: ready-made frames from files to the frame store; "
            "bake: a frame of each material, its time beside that of its rays, its errors, and the hours "
            "of a whole bake")
        ->required()
        ->check(CLI::IsMember({"lut", "reproject", "present", "frames", "bake"}));
    bench_command
        .add_option("--mesh", bench.mesh,
                    "Measure on this mesh (PLY, OBJ, STL) instead of the shipped sculptures")
        ->type_name("FILE");
    bench_command.add_option("--up", bench.up, "Axis of the mesh file that points up")
        ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
        ->capture_default_str();
    bench_command.add_option("--size", bench.size_px, "Width and height of the picture")
        ->type_name("PX")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    bench_command
        .add_option("--probe", bench.probe,
                    "bake: a latitude-longitude picture of the surroundings instead of the overcast sky")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    bench_command
        .add_option("--samples", bench.samples, "bake: samples of a pixel, of the frames that are timed")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    bench_command
        .add_option("--reference-size", bench.reference_size_px,
                    "bake: width and height of the pictures whose errors are measured, against 1024 "
                    "samples; from 384 on they have targets")
        ->type_name("PX")
        ->check(CLI::Range(16, 2048))
        ->capture_default_str();
    add_context_option(bench_command, bench.context);
    bench_command.add_flag("--json", bench.json, "Print JSON");
    bench_command.callback([&] { command = [&] { return run_bench(bench); }; });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too, with code 0; all else is bad input.
        return app.exit(error) == 0 ? 0 : 2;
    }
    return command();
}

} // namespace overt
