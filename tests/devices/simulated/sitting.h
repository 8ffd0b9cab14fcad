/// A simulated observer before a display that is nothing but a list of flips, in virtual time.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "devices/host/clocks.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "devices/simulated/simulated_observer.h"
#include "experiment/animation.h"
#include "tests/support/figures.h"

namespace overt::test {

/// Two tasks ("head share" 0.4 and 0.15) about one bust.
inline ObservedScene scene_with(const Mesh& mesh) {
    ObservedScene scene;
    const View view{fit_camera(mesh, {11.9}, {1024, 1024}, {25.0}, 0.06), {1024, 1024}};
    scene.objects = {{&mesh, SceneView{view, mesh.bounds()}}};
    scene.tasks = {{"free", {0.4}}, {"clothes", {0.15}}};
    scene.display_latency = std::chrono::microseconds(3500);
    return scene;
}

inline ObserverSettings without_wandering() {
    ObserverSettings settings;
    settings.drift = settings.tremor = Degrees{0.0};
    return settings;
}

class SimulatedSitting {
  public:
    Mesh mesh = bust();
    VirtualClock clock;
    SimulatedObserver observer;
    std::vector<FlipRecord> flips; ///< of the last presentation

    explicit SimulatedSitting(std::uint64_t seed, const ObserverSettings& settings = {})
        : observer(scene_with(mesh), seed, settings) {}

    /// Shows one trial, with a refresh missed before each refresh that `missed` names. Calls `at_flip` after
    /// each flip was seen.
    void present(
        const Trial& trial, const std::vector<int>& missed = {},
        const std::function<void()>& at_flip = [] {}) {
        const ObservedScene& scene = observer.scene();
        const PageCycle cycle = make_page_cycle(scene.animations[0], scene.refresh_hz);
        flips.clear();
        flips.reserve(static_cast<std::size_t>(cycle.total_refreshes));
        observer.screen_shown({}, next_blank());
        const SessionTime onset = next_blank();
        observer.presentation_begins(trial, 0);
        int refresh = 0;
        while (refresh < cycle.total_refreshes) {
            const PageCycleEntry& entry = cycle.entry_at(refresh);
            FlipRecord flip{trial.index, refresh, entry.frame, entry.frame, entry.pose, {}};
            for (const int late : missed)
                flip.refresh_in_trial += late == refresh;
            flip.report.vertical_blank = onset + from_seconds(flip.refresh_in_trial / scene.refresh_hz);
            clock.wait_until(flip.report.vertical_blank);
            flips.push_back(flip);
            observer.flipped(flip);
            at_flip();
            refresh = flip.refresh_in_trial + 1;
        }
        const SessionTime end = onset + from_seconds(refresh / scene.refresh_hz);
        clock.wait_until(end);
        observer.screen_shown({}, end);
    }

    SessionTime onset() const { return flips.front().report.vertical_blank; }

    /// By the flips themselves: the frame lit at a place at a time, as the display has it.
    AnimationFrameIndex frame_lit(SessionTime time, double y_px) const {
        const SessionTime blank = time - observer.scene().light_delay(y_px);
        AnimationFrameIndex frame = flips.front().shown;
        for (const FlipRecord& flip : flips) {
            if (flip.report.vertical_blank <= blank)
                frame = flip.shown;
        }
        return frame;
    }

  private:
    SessionTime next_blank() {
        clock.wait_until(clock.now() + std::chrono::milliseconds(1200));
        return clock.now();
    }
};

/// Angle between two gazes, in degrees.
inline double degrees_between(const ObservedScene& scene, ScreenPoint a, ScreenPoint b) {
    return scene.screen.angle_between(a, b).value;
}

} // namespace overt::test
