#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/power/power_simulation.h"

namespace overt {

BenchFigures bench_power(const BenchOptions& options) {
    BenchScene scene = bench_scene(options);
    // The shipped experiment's materials and tasks: 30 trials with three sculptures.
    Protocol& protocol = scene.protocol;
    for (const char* id : {"smooth", "rough", "coated"}) {
        MaterialSettings material;
        material.id = id;
        protocol.materials.push_back(std::move(material));
    }
    for (const double head_share : {0.4, 0.35, 0.61, 0.4, 0.155, 0.2}) {
        Task task;
        task.id = fmt::format("task_{}", protocol.tasks.size() + 1);
        task.stimuli =
            protocol.tasks.size() < 2 ? TaskCoverage::every_stimulus : TaskCoverage::once_per_object;
        task.simulated_head_share = head_share;
        protocol.tasks.push_back(std::move(task));
    }
    const Experiment experiment{protocol, std::move(scene.objects)};
    PowerSettings settings;
    settings.observers = {12};
    settings.studies = 21;
    settings.jobs = 1;
    settings.gaze = gaze_study_settings(protocol);
    BenchFigures figures;
    const auto measure = [&](const char* what, const std::vector<std::string>& effects) {
        // From the end of the first study on: what is made once for all does not count.
        double begin = 0.0, end = 0.0;
        simulate_power(experiment, power_effects(effects, protocol, areas_of(experiment.objects)), settings,
                       [&](std::string_view piece, int done, int) {
                           if (piece == "studies")
                               (done == 1 ? begin : end) = processor_seconds();
                       });
        const double rate = 60.0 * (settings.studies - 1) / (end - begin);
        // Set for the shipped sculptures and their 30 trials.
        figures.push_back(options.mesh.empty() ? at_least(what, rate, "studies/min", 20.0)
                                               : BenchFigure{what, rate, "studies/min"});
    };
    measure("studies of 12 observers per minute and core, share on the head",
            {"head:material=rough:odds=1.5"});
    measure("the same, share on the head, WSS and CC", {"none"});
    return figures;
}

} // namespace overt
