#include "app/rig/operator_equipment.h"

#include <chrono>

#include "experiment/protocol/protocol.h"
#include "experiment/record/preview_file.h"

namespace overt {

namespace {

/// "left: vase, right: bowl": the entry of each slot's stimulus.
template <class Entry>
std::string in_slots(const Protocol& protocol, const Trial& trial, const std::vector<Entry>& entries,
                     int Stimulus::*index) {
    std::string text;
    for (const auto& [stimulus, slot] : trial.all_shown())
        text += (text.empty() ? "" : ", ") + protocol.slots[static_cast<std::size_t>(slot)].id + ": " +
                entries[static_cast<std::size_t>(stimulus.*index)].id;
    return text;
}

} // namespace

OperatorServer::Options operator_view_of(const SessionHeader& header, const Protocol& protocol,
                                         const std::filesystem::path& folder, bool has_tracker, int completed,
                                         const Clock* steady) {
    OperatorServer::Options options;
    SessionFacts& facts = options.facts;
    facts.protocol = protocol.name;
    facts.observer = header.schedule.observer.label;
    facts.folder = std::filesystem::absolute(folder).lexically_normal().string();
    facts.trials = static_cast<int>(header.schedule.trials.size());
    facts.refresh_hz = protocol.display.refresh_hz;
    facts.width_px = protocol.display.width_px;
    facts.height_px = protocol.display.height_px;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    facts.image_width_px = geometry.image_px.x;
    facts.image_height_px = geometry.image_px.y;
    facts.poses = static_cast<int>(header.poses.angles.size());
    facts.has_tracker = has_tracker;
    facts.is_timing_unproven = header.display.is_timing_unproven();
    facts.drift_limit_deg = protocol.tracker.drift_limit_deg;
    facts.mean_limit_deg = protocol.calibration.mean_limit_deg;
    facts.max_limit_deg = protocol.calibration.max_limit_deg;
    facts.skip_reasons = protocol.operators.skip_reasons;
    if (steady)
        facts.clock_zero_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count() -
            to_seconds(steady->now());
    options.completed = completed;
    for (const Trial& trial : header.schedule.trials) {
        const Task& task = protocol.tasks[static_cast<std::size_t>(trial.task)];
        ViewedTrial viewed{
            task.id,
            task.question,
            protocol.objects[static_cast<std::size_t>(trial.stimulus.object)].id,
            protocol.materials[static_cast<std::size_t>(trial.stimulus.material)].id,
            light_file(header, trial.stimulus),
            trial.stimulus.view,
            shown_pictures(header.animation_of(trial.stimulus), header.poses.frames_of(trial.stimulus.motion))
                .of_frame};
        // Where gaze meets the surface is shown of one object in the place of the image: else only what is
        // where.
        if (!protocol.slot_entries.empty()) {
            viewed.object = in_slots(protocol, trial, protocol.objects, &Stimulus::object);
            viewed.material = in_slots(protocol, trial, protocol.materials, &Stimulus::material);
            viewed.light_file.clear();
        }
        if (!std::filesystem::exists(folder / viewed.light_file))
            viewed.light_file.clear();
        options.trials.push_back(std::move(viewed));
    }
    return options;
}

} // namespace overt
