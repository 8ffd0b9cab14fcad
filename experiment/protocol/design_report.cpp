#include "experiment/protocol/design_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/schedule.h"

namespace overt {

namespace {

template <class Entry> std::vector<std::string> ids_of(const std::vector<Entry>& entries) {
    std::vector<std::string> ids;
    for (const Entry& entry : entries)
        ids.push_back(entry.id);
    return ids;
}

AnimationFacts animation_facts(const Protocol& protocol) {
    const Animation& animation = protocol.animation;
    const PageCycle cycle = make_page_cycle(animation, protocol.display.refresh_hz);
    AnimationFacts facts;
    facts.frames = animation.frame_count;
    facts.distinct_poses = static_cast<int>(distinct_poses(animation).angles.size());
    facts.shown_frames = animation.shown_frame_count();
    facts.refreshes_per_frame = refreshes_per_frame(animation.frame_rate_hz, protocol.display.refresh_hz);
    facts.refreshes = cycle.total_refreshes;
    facts.duration_s = cycle.total_refreshes / protocol.display.refresh_hz;
    facts.periods = static_cast<double>(facts.shown_frames) / animation.steps_per_period();
    return facts;
}

VisualAngles visual_angles(const Protocol& protocol) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const ScreenPoint centre = geometry.centre();
    const auto width_deg = [&](double px) {
        return geometry
            .angle_between({centre.x_px - 0.5 * px, centre.y_px}, {centre.x_px + 0.5 * px, centre.y_px})
            .value;
    };
    const auto height_deg = [&](double px) {
        return geometry
            .angle_between({centre.x_px, centre.y_px - 0.5 * px}, {centre.x_px, centre.y_px + 0.5 * px})
            .value;
    };
    VisualAngles angles;
    angles.screen_width_deg = width_deg(geometry.screen_px.x);
    angles.screen_height_deg = height_deg(geometry.screen_px.y);
    angles.image_width_deg = width_deg(geometry.image_px.x);
    angles.image_height_deg = height_deg(geometry.image_px.y);
    angles.camera_fov_deg = protocol.view.vertical_fov_deg.value_or(angles.image_height_deg);
    angles.px_per_deg = geometry.px_per_deg_at_centre();
    return angles;
}

SessionLength session_length(const Protocol& protocol, int trials, double animation_s,
                             const DesignAssumptions& assumptions) {
    const ScreenSettings& screens = protocol.screens;
    SessionLength length;
    length.calibration_s = assumptions.calibration_s;
    length.questions_s = trials * std::max(screens.task_min_s, assumptions.question_s);
    length.drift_checks_s = trials * screens.drift_target_s;
    length.animations_s = trials * (animation_s + 2.0 * screens.recording_lead_s);
    length.answers_s =
        trials * std::clamp(assumptions.answer_s, screens.response_min_s, screens.response_max_s);
    return length;
}

std::vector<IncidenceCell> incidence(const Protocol& protocol) {
    const int sculptures = static_cast<int>(protocol.sculptures.size());
    const int materials = static_cast<int>(protocol.materials.size());
    std::vector<IncidenceCell> cells;
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task) {
        for (int sculpture = 0; sculpture < sculptures; ++sculpture) {
            for (int material = 0; material < materials; ++material)
                cells.push_back({task, {sculpture, material}, 0});
        }
    }
    for (int observer = 1; observer <= protocol.schedule.observers; ++observer) {
        for (const Trial& trial : trials_of(protocol, observer)) {
            const int cell =
                (trial.task * sculptures + trial.condition.sculpture) * materials + trial.condition.material;
            ++cells[static_cast<std::size_t>(cell)].presentations;
        }
    }
    return cells;
}

std::vector<std::string> balance_warnings(const DesignReport& report) {
    std::vector<std::string> warnings;
    const std::size_t cells_per_task = report.incidence.size() / report.tasks.size();
    for (std::size_t task = 0; task < report.tasks.size(); ++task) {
        const auto begin = report.incidence.begin() + static_cast<std::ptrdiff_t>(task * cells_per_task);
        const auto [least, most] = std::minmax_element(
            begin, begin + static_cast<std::ptrdiff_t>(cells_per_task),
            [](const IncidenceCell& a, const IncidenceCell& b) { return a.presentations < b.presentations; });
        if (least->presentations != most->presentations) {
            warnings.push_back(fmt::format(
                "under task \"{}\" some stimuli are shown {} times and others {} times: let the "
                "number of observers be a multiple of {}",
                report.tasks[task], least->presentations, most->presentations, report.materials.size()));
        }
    }
    return warnings;
}

} // namespace

std::vector<Observer> planned_observers(const Protocol& protocol) {
    std::vector<Observer> observers;
    for (int number = 1; number <= protocol.schedule.observers; ++number)
        observers.push_back({fmt::format("{:02}", number), number});
    return observers;
}

DesignReport make_design_report(const Protocol& protocol, const std::vector<Observer>& observers,
                                std::uint64_t example_seed, const DesignAssumptions& assumptions) {
    DesignReport report;
    report.name = protocol.name;
    report.title = protocol.title;
    report.tasks = ids_of(protocol.tasks);
    report.sculptures = ids_of(protocol.sculptures);
    report.materials = ids_of(protocol.materials);
    report.trials_per_observer = static_cast<int>(trials_of(protocol, 1).size());
    report.observers = protocol.schedule.observers;
    report.display = protocol.display;
    report.view = protocol.view;
    report.motion = protocol.animation;
    report.animation = animation_facts(protocol);
    report.angles = visual_angles(protocol);
    report.assumptions = assumptions;
    report.session =
        session_length(protocol, report.trials_per_observer, report.animation.duration_s, assumptions);
    const double pose_px = static_cast<double>(report.animation.distinct_poses) * protocol.view.width_px *
                           protocol.view.height_px;
    report.memory = {pose_px * assumptions.bytes_per_page_px, pose_px * assumptions.bytes_per_map_px};
    report.incidence = incidence(protocol);
    report.is_seed_fixed = protocol.schedule.seed.has_value();
    for (const Observer& observer : observers)
        report.schedules.push_back(
            make_schedule(protocol, observer, protocol.schedule.seed.value_or(example_seed)));
    report.warnings = balance_warnings(report);
    return report;
}

} // namespace overt
