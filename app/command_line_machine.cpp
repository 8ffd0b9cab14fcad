#include "app/command_line_groups.h"

namespace overt {

namespace {

void add_doctor(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<DoctorOptions>();
    DoctorOptions& options = *given;
    CLI::App& command =
        add_command(app, "doctor", "What this machine offers for a session", "overt doctor --json");
    command.add_flag("--json", options.json, "Print JSON");
    command.add_flag("--window", options.window,
                     "Show a dark screen, measure its refreshes, and say what may spoil their times");
    command.add_flag("--photodiode", options.photodiode,
                     "Show a square in the top left corner that changes, and compare what a sensor sees "
                     "with the times of the flips");
    command
        .add_option(
            "--sensor", options.sensor,
            "Serial port of a light sensor that sends 1 and 0, or `simulated` (5 ms late, 0.2 ms jitter)")
        ->type_name("PORT");
    add_context_option(command, options.context);
    command.add_flag("--windowed", options.windowed, "A window instead of the whole screen");
    command.add_option("--monitor", options.monitor, "The screen to take, as this command numbers them")
        ->type_name("N")
        ->check(above_zero());
    command.add_option("--seconds", options.seconds, "How long to measure")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    run_when_chosen(command, chosen, [given] { return run_doctor(*given); });
}

void add_bench(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<BenchOptions>();
    BenchOptions& options = *given;
    CLI::App& command = add_command(app, "bench", "The program's own benchmarks",
                                    "overt bench lut --json\n"
                                    "  overt bench lut --mesh statue.ply --up y");
    command
        .add_option(
            "WHICH", options.what,
            "lut: the hidden pass, its exactness, time and memory; reproject: gaze to "
            "surface, its exactness, speed and memory; present: a flip of a page, its time, processor "
            "time, packing and memory, and the timing of presentations on displays whose faults are known; "
            "frames: ready-made frames from files to the frame store; "
            "bake: a frame of each material, its time beside that of its rays, its errors, and the hours "
            "of a whole bake; "
            "export: exports and imports, their speed, and their memory as sessions grow")
        ->required()
        ->check(CLI::IsMember({"lut", "reproject", "present", "frames", "bake", "export"}));
    command
        .add_option("--mesh", options.mesh,
                    "Measure on this mesh (PLY, OBJ, STL) instead of the shipped sculptures")
        ->type_name("FILE");
    command.add_option("--up", options.up, "Axis of the mesh file that points up")
        ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
        ->capture_default_str();
    command.add_option("--size", options.size_px, "Width and height of the picture")
        ->type_name("PX")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    command
        .add_option("--probe", options.probe,
                    "bake: a latitude-longitude picture of the surroundings instead of the overcast sky")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command
        .add_option("--samples", options.samples, "bake: samples of a pixel, of the frames that are timed")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command
        .add_option("--reference-size", options.reference_size_px,
                    "bake: width and height of the pictures whose errors are measured, against 1024 "
                    "samples; from 384 on they have targets")
        ->type_name("PX")
        ->check(CLI::Range(16, 2048))
        ->capture_default_str();
    add_context_option(command, options.context);
    command.add_flag("--json", options.json, "Print JSON");
    run_when_chosen(command, chosen, [given] { return run_bench(*given); });
}

} // namespace

void add_machine_commands(CLI::App& app, ChosenCommand& chosen) {
    add_doctor(app, chosen);
    add_bench(app, chosen);
}

} // namespace overt
