/// The command that measures accuracy and speed. Each takes its options and gives the exit code, 0 done, 1
/// failed. Bad input is thrown as InputError, which main turns into exit code 2.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "experiment/events/event_thresholds.h"

namespace overt {

/// Adds it to the command line.
void add_bench_commands(CLI::App& app, ChosenCommand& chosen);

struct BenchOptions {
    std::string what;                         ///< which benchmark
    std::vector<std::filesystem::path> files; ///< events: recordings, or folders of them; analyze: sessions
    std::filesystem::path mesh;               ///< measure on this one instead of the shipped sculptures
    std::string up;                           ///< axis of the mesh file that points up; empty: its format's
    int size_px = 1024;                       ///< width and height of the picture
    std::filesystem::path probe;              ///< bake: surroundings other than the overcast sky
    int samples = 16;                         ///< bake: of a pixel, of the frames whose time is taken
    int reference_size_px = 128;              ///< bake: of the pictures whose errors are measured
    double seconds = 60.0;                    ///< tracker, watch: of real time
    ChosenThresholds thresholds;              ///< events: those that are not left to the gaze
    ContextChoice context;
    int studies = 0;       ///< statistics: of each kind; 0: all that its table is of
    bool is_quick = false; ///< growth: over a few trials and sessions only
    bool json = false;
};
int run_bench(const BenchOptions& options);

} // namespace overt
