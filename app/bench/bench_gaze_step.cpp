#include <algorithm>

#include "app/bench/bench_command.h"
#include "app/bench/gaze_step_simulation.h"
#include "app/cli/own_folders.h"

namespace overt {

namespace {

/// The same object in two slots of different sizes, in the second in a motion of its own: gaze is waited for
/// in the second.
struct TwoSlots {
    BenchScene bench;
    GazeStepScene shown;
};

TwoSlots two_slots(BenchScene bench) {
    Protocol& protocol = bench.protocol;
    protocol.slot_entries.resize(2);
    SlotSettings &left = protocol.slot_entries[0], &right = protocol.slot_entries[1];
    left.id = "left";
    left.right_deg = -5.5;
    left.size_deg = 10.0;
    right.id = "right";
    right.right_deg = 5.5;
    right.up_deg = 1.0;
    right.size_deg = 6.0;
    protocol.slots = written_out(protocol.slot_entries);
    fit_views_to_slots(protocol);
    protocol.motions.resize(2);
    protocol.motions[1].amplitude = {-20.0};
    bench.objects = load_objects(protocol, cache_folder());
    Stimulus turned;
    turned.motion = 1;
    return {std::move(bench), {{{{}, 0}, {turned, 1}}, 1}};
}

} // namespace

BenchFigures bench_gaze_step(const BenchOptions& options) {
    constexpr int trials = 1000;
    const BenchScene scene = bench_scene(options);
    // The shipped objects have a head; of others the first part is taken.
    const std::vector<std::string>& parts = scene.objects.front().mesh->part_names;
    const std::string area = std::ranges::find(parts, "head") == parts.end() ? parts.front() : "head";
    const GazeStepTrials found = simulate_gaze_steps(scene.protocol, scene.objects, area, trials, 1);
    const TwoSlots two = two_slots(bench_scene(options));
    const GazeStepTrials second =
        simulate_gaze_steps(two.bench.protocol, two.bench.objects, area, trials, 2, two.shown);
    return {
        at_least("trials of 1000 that gaze on a moving area ended by the planted sample, 2000 Hz",
                 found.at_planted_sample, "", trials),
        at_least("trials that end by the same sample when they are read", found.again_from_record, "",
                 trials),
        at_least("trials that end with the first flip after the sample came", found.at_next_flip, "", trials),
        at_least("the same of 1000 with two slots that wait for gaze in the second", second.at_planted_sample,
                 "", trials),
        at_least("of these, that end by the same sample when they are read", second.again_from_record, "",
                 trials),
        at_least("of these, that end with the first flip after the sample came", second.at_next_flip, "",
                 trials),
        {"samples on the area",
         100.0 * static_cast<double>(found.on_area) / static_cast<double>(found.samples), "%"},
        {"a look at a sample, ray included", found.look_us, "us"}};
}

} // namespace overt
