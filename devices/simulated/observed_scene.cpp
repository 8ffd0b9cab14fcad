#include "devices/simulated/observed_scene.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {

SessionDuration ObservedScene::light_delay(double y_px) const {
    const double rows = screen.screen_px.y;
    return display_latency + from_seconds(std::clamp(y_px, 0.0, rows) / (rows * refresh_hz));
}

double ObservedScene::longest_s() const {
    return std::max(longest_step_s, std::ranges::max(animations, {}, &Animation::duration_s).duration_s);
}

SessionDuration ObservedScene::frame_period(int motion) const {
    const Animation& animation = animation_of(motion);
    const int refreshes = refreshes_per_frame(animation.frame_rate_hz, refresh_hz);
    return from_seconds(refreshes > 0 ? refreshes / refresh_hz : 1.0 / animation.frame_rate_hz);
}

ObservedScene make_observed_scene(const Protocol& protocol, std::span<const Object> objects,
                                  const ScreenGeometry& screen) {
    ObservedScene scene;
    scene.screen = screen;
    scene.animations.assign(protocol.motions.begin(), protocol.motions.end());
    scene.views = static_cast<int>(protocol.views_at_all_sizes());
    scene.first_view = protocol.in_slot({}).view;
    scene.refresh_hz = protocol.display.refresh_hz;
    scene.display_latency = from_seconds(1e-3 * protocol.display.latency_ms);
    for (const Object& object : objects) {
        for (const SceneView& view : object.scenes)
            scene.objects.push_back({object.has_mesh() ? &*object.mesh : nullptr, view});
    }
    for (const Task& task : protocol.tasks) {
        for (const auto& [area, share] : simulated_shares(task)) {
            if (area_in(scene, area) < 0)
                scene.areas.push_back(area);
        }
    }
    OVERT_EXPECTS(scene.areas.size() <= most_observed_areas);
    for (const Task& task : protocol.tasks) {
        ObservedTask observed{task.id, std::vector<double>(scene.areas.size(), 0.0)};
        for (const auto& [area, share] : simulated_shares(task))
            observed.shares[static_cast<std::size_t>(area_in(scene, area))] = share;
        scene.tasks.push_back(std::move(observed));
    }
    const auto number_of = [](const std::string& id, const auto& entries) {
        const auto found = std::ranges::find(entries, id, [](const auto& entry) { return entry.id; });
        return id.empty() || found == entries.end() ? -1 : static_cast<int>(found - entries.begin());
    };
    for (const SimulatedEffect& effect : protocol.simulated_effects) {
        const bool is_of_area = !effect.area.empty();
        scene.effects.push_back({number_of(effect.task, protocol.tasks), chosen_by(protocol, effect),
                                 is_of_area ? std::max(area_in(scene, effect.area), 0) : 0,
                                 is_of_area ? effect.area_odds : effect.head_odds, effect.spot_share,
                                 effect.spread});
    }
    if (!protocol.slot_entries.empty())
        for (const Slot& slot : protocol.slots) {
            scene.slots.push_back(slot_geometry(protocol, slot));
            scene.slot_views.push_back(slot.size * static_cast<int>(protocol.views.size()));
        }
    for (const Task& task : protocol.tasks)
        for (const StepSettings& step : task.steps)
            if (step.kind == StepKind::show && (step.duration || step.ends_by_answer))
                scene.longest_step_s =
                    std::max(scene.longest_step_s,
                             step.duration ? step.duration->longest_s() : protocol.screens.response_max_s);
    scene.share_sd = protocol.simulated_observers.head_share_sd;
    return scene;
}

int area_in(const ObservedScene& scene, std::string_view area) {
    const auto found = std::ranges::find(scene.areas, area);
    return found == scene.areas.end() ? -1 : static_cast<int>(found - scene.areas.begin());
}

glm::dvec2 px_per_deg_at_centre(const ScreenGeometry& screen) {
    return std::tan(to_radians({1.0}).value) * screen.viewing_distance_mm * glm::dvec2(screen.screen_px) /
           screen.screen_mm;
}

} // namespace overt
