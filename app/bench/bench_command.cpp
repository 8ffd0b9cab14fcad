#include "app/bench/bench_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/command_options.h"
#include "app/cli/event_options.h"
#include "app/cli/own_folders.h"
#include "experiment/base/error.h"
#include "experiment/scene/sculptures/sculptures.h"

namespace overt {

namespace {

/// One row a benchmark: the word on the command line, what its help says, and the function.
struct Benchmark {
    std::string_view name, what;
    BenchFigures (*measure)(const BenchOptions&);
};

constexpr Benchmark benchmarks[] = {
    {"lut", "the hidden pass, its exactness, time and memory", bench_lut},
    {"reproject", "gaze to surface, its exactness, speed and memory", bench_reproject},
    {"present",
     "a flip of a page, its time, processor time, packing and memory, and the timing of presentations on "
     "displays whose faults are known",
     bench_present},
    {"frames", "ready-made frames from files to the frame store", bench_frames},
    {"bake",
     "a frame of each material, its time beside that of its rays, its errors, and the hours of a whole bake",
     bench_bake},
    {"export", "exports and imports, their speed, and their memory as sessions grow", bench_export},
    {"events", "fixations and saccades against those of a tracker, of people, or planted ones; its speed",
     bench_events},
    {"analyze", "a study of given sessions, its time and memory; blurring, its speed and exactness",
     bench_analyze},
    {"power", "simulated studies of 12 observers, how many a minute on one core", bench_power},
    {"tracker", "an eye tracker at 2000 Hz beside a presentation, its samples, processor time and refreshes",
     bench_tracker},
    {"gaze-step", "steps that gaze on a moving area ends, and whether they end by the planted sample",
     bench_gaze_step},
    {"input", "from a key that the window system is given to the refresh that shows it", bench_input},
    {"procedures",
     "procedures that choose levels, and fits of answers, against known answers and simulated observers",
     bench_procedures},
    {"statistics",
     "the analysis of 4,000 simulated studies: how often tests find what is not there, and intervals hold "
     "the truth "
     "(hours)",
     bench_statistics},
    {"growth",
     "run, export, analyze, verify and replay over 30, 300 and 3,000 trials and 10, 100 and 1,000 sessions, "
     "their "
     "time, memory and exponents",
     bench_growth},
    {"materials", "plastics, rough metals and mixtures against laws of light and known numbers",
     bench_materials},
    {"live", "frames that OpenGL draws of each kind of material, held against baked ones in CIEDE2000",
     bench_live},
    {"watch", "the operator's view, from a sample to its surface point and to its mark in the window",
     bench_watch}};

void add_bench(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<BenchOptions>();
    BenchOptions& options = *given;
    CLI::App& command = add_command(app, "bench", "The program's own benchmarks",
                                    "overt bench lut --json\n"
                                    "  overt bench lut --mesh statue.ply --up y\n"
                                    "  overt bench events recordings --json\n"
                                    "  overt bench procedures");
    std::vector<std::string> names, lines;
    for (const Benchmark& one : benchmarks) {
        names.emplace_back(one.name);
        lines.push_back(fmt::format("{}: {}", one.name, one.what));
    }
    command.add_option("WHICH", options.what, fmt::format("{}", fmt::join(lines, "; ")))
        ->required()
        ->check(one_of(names));
    command.add_option(
        "FILE", options.files,
        "events: EyeLink recordings (.asc) with the tracker's own events, tables of samples that "
        "people labelled (.tsv), or folders of them; without any, gaze with planted events. analyze: "
        "sessions");
    command
        .add_option("--mesh", options.mesh,
                    "Measure on this mesh (PLY, OBJ, STL) instead of the shipped sculptures")
        ->type_name("FILE");
    command.add_option("--up", options.up, "Axis of the mesh file that points up (z; of glTF y)")
        ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
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
    command
        .add_option("--seconds", options.seconds, "tracker, watch, input: of real time, for each measurement")
        ->type_name("S")
        ->check(CLI::Range(0.5, 3600.0))
        ->capture_default_str();
    command
        .add_option("--studies", options.studies,
                    "statistics: simulated studies of each of 8 kinds; from 20 on they have targets")
        ->type_name("N")
        ->check(CLI::Range(1, 100000))
        ->default_str("500");
    command.add_flag(
        "--quick", options.is_quick,
        "growth: over 2 to 6 trials and 2 to 4 sessions; statistics: 3 studies of each kind; to see "
        "that it goes, without targets");
    add_threshold_options(command, options.thresholds);
    add_context_option(command, options.context);
    add_json_flag(command, options.json);
    run_when_chosen(command, chosen, [given] { return run_bench(*given); });
}

} // namespace

BenchScene bench_scene(const BenchOptions& options) {
    BenchScene scene;
    scene.protocol.name = "bench";
    scene.protocol.views.front().width_px = scene.protocol.views.front().height_px = options.size_px;
    if (!options.mesh.empty()) {
        ObjectSettings settings;
        settings.id = options.mesh.stem().string();
        settings.mesh = options.mesh;
        settings.up = options.up;
        scene.protocol.objects.push_back(std::move(settings));
    } else {
        for (const SculptureDescription& shipped : shipped_sculptures()) {
            ObjectSettings settings;
            settings.id = settings.shipped = std::string(shipped.name);
            scene.protocol.objects.push_back(std::move(settings));
        }
    }
    scene.objects = load_objects(scene.protocol, cache_folder());
    return scene;
}

int run_bench(const BenchOptions& options) {
    const auto chosen = std::find_if(std::begin(benchmarks), std::end(benchmarks),
                                     [&](const Benchmark& one) { return one.name == options.what; });
    if (chosen == std::end(benchmarks))
        throw InputError(fmt::format("there is no benchmark \"{}\": see overt bench --help", options.what));
    const BenchFigures figures = chosen->measure(options);
    if (options.json) {
        fmt::print("{}\n", to_json(figures).dump(2));
    } else {
        print_table(figures);
    }
    return all_hold(figures) ? 0 : 1;
}

void add_bench_commands(CLI::App& app, ChosenCommand& chosen) { add_bench(app, chosen); }

} // namespace overt
