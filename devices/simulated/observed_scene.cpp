#include "devices/simulated/observed_scene.h"

#include <algorithm>
#include <cmath>

namespace overt {

SessionDuration ObservedScene::light_delay(double y_px) const {
    const double rows = screen.screen_px.y;
    return display_latency + from_seconds(std::clamp(y_px, 0.0, rows) / (rows * refresh_hz));
}

double ObservedScene::longest_s() const {
    return std::ranges::max(animations, {}, &Animation::duration_s).duration_s;
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
    scene.views = static_cast<int>(protocol.views.size());
    scene.refresh_hz = protocol.display.refresh_hz;
    scene.display_latency = from_seconds(1e-3 * protocol.display.latency_ms);
    for (const Object& object : objects) {
        for (const SceneView& view : object.scenes)
            scene.objects.push_back({object.has_mesh() ? &object.mesh : nullptr, view});
    }
    for (const Task& task : protocol.tasks)
        scene.tasks.push_back({task.id, task.simulated_head_share});
    const auto number_of = [](const std::string& id, const auto& entries) {
        const auto found = std::ranges::find(entries, id, [](const auto& entry) { return entry.id; });
        return id.empty() || found == entries.end() ? -1 : static_cast<int>(found - entries.begin());
    };
    for (const SimulatedEffect& effect : protocol.simulated_effects)
        scene.effects.push_back({number_of(effect.task, protocol.tasks), chosen_by(protocol, effect),
                                 effect.head_odds, effect.spot_share, effect.spread});
    if (!protocol.slot_entries.empty())
        for (const Slot& slot : protocol.slots)
            scene.slots.push_back(slot_geometry(protocol, slot));
    scene.head_share_sd = protocol.simulated_observers.head_share_sd;
    return scene;
}

glm::dvec2 px_per_deg_at_centre(const ScreenGeometry& screen) {
    return std::tan(to_radians({1.0}).value) * screen.viewing_distance_mm * glm::dvec2(screen.screen_px) /
           screen.screen_mm;
}

} // namespace overt
