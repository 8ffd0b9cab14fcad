#include "app/rig/operator_equipment.h"

#include <chrono>

#include "experiment/protocol/protocol.h"
#include "experiment/record/preview_file.h"

namespace overt {

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
    const ScreenGeometry screen = screen_geometry_of(protocol);
    facts.width_px = screen.screen_px.x;
    facts.height_px = screen.screen_px.y;
    for (const Slot& slot : protocol.slots) {
        const ImageBox at = slot_geometry(protocol, slot).image_box();
        facts.slots.push_back({slot.id, at.origin_px.x, at.origin_px.y, at.size_px.x, at.size_px.y});
    }
    facts.poses = static_cast<int>(header.poses.angles.size());
    facts.has_tracker = has_tracker;
    facts.is_timing_unproven = header.is_timing_unproven();
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
        ViewedTrial viewed{task.id, task.question};
        for (const PlacedStimulus& placed : trial.all_shown()) {
            const Stimulus stimulus = header.in_slot(placed);
            ViewedStimulus& shown = viewed.shown.emplace_back();
            shown.slot = placed.slot;
            shown.object = protocol.object_of(stimulus).id;
            shown.material = protocol.material_of(stimulus).id;
            shown.seen_in = stimulus.view;
            if (std::string file = light_file(header, stimulus); std::filesystem::exists(folder / file))
                shown.light_file = std::move(file);
            viewed.picture_of_frame.push_back(
                shown_pictures(header.animation_of(stimulus), header.poses.frames_of(stimulus.motion))
                    .of_frame);
        }
        options.trials.push_back(std::move(viewed));
    }
    return options;
}

} // namespace overt
