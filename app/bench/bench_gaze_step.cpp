#include <algorithm>

#include "app/bench/bench_command.h"
#include "app/bench/gaze_step_simulation.h"

namespace overt {

BenchFigures bench_gaze_step(const BenchOptions& options) {
    constexpr int trials = 1000;
    const BenchScene scene = bench_scene(options);
    // The shipped objects have a head; of others the first part is taken.
    const std::vector<std::string>& parts = scene.objects.front().mesh->part_names;
    const std::string area = std::ranges::find(parts, "head") == parts.end() ? parts.front() : "head";
    const GazeStepTrials found = simulate_gaze_steps(scene.protocol, scene.objects, area, trials, 1);
    return {
        at_least("trials of 1000 that gaze on a moving area ended by the planted sample, 2000 Hz",
                 found.at_planted_sample, "", trials),
        at_least("trials that end by the same sample when they are read", found.again_from_record, "",
                 trials),
        at_least("trials that end with the first flip after the sample came", found.at_next_flip, "", trials),
        {"samples on the area",
         100.0 * static_cast<double>(found.on_area) / static_cast<double>(found.samples), "%"},
        {"a look at a sample, ray included", found.look_us, "us"}};
}

} // namespace overt
