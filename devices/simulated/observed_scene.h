/// What a simulated observer can look at, and how its light reaches the eye.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/animation.h"
#include "experiment/protocol/protocol.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/mesh.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"
#include "experiment/session_time.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"

namespace overt {

struct ObservedObject {
    const Mesh* mesh = nullptr; ///< nullptr or without triangles: ready-made frames whose surface is unknown
    SceneView scene;
};

/// Most of ObservedScene::areas.
inline constexpr std::size_t most_observed_areas = most_simulated_areas;

struct ObservedTask {
    std::string id;
    std::vector<double> shares; ///< of fixations that go to each of ObservedScene::areas; 0 … 1 together
};

/// What the gaze depends on besides the task; -1: any.
struct ObservedEffect {
    int task = -1, object = -1, material = -1;
    int area = 0; ///< index into ObservedScene::areas
    double odds = 1.0, spot_share = 0.0;
    double spread = 0.0; ///< see GazePlan

    bool holds_in(int of_task, Stimulus stimulus) const {
        return (task < 0 || task == of_task) && (object < 0 || object == stimulus.object) &&
               (material < 0 || material == stimulus.material);
    }
};

struct ObservedScene {
    ScreenGeometry screen;
    Animation animation;
    double refresh_hz = 120.0;
    SessionDuration display_latency{};                      ///< from vertical blank to the first row's light
    std::vector<ObservedObject> objects;                    ///< by Stimulus::object
    std::vector<std::string> areas{std::string(head_area)}; ///< that gaze is meant for, without overlap
    std::vector<ObservedTask> tasks;                        ///< by Trial::task
    std::vector<ObservedEffect> effects = {};
    double share_sd = 0.0; ///< of the logit of each area's share, over observers

    /// From vertical blank to the light of a row: rows are lit one after another, evenly over one refresh.
    /// Rows above and below the screen are taken as its first and last.
    SessionDuration light_delay(double y_px) const;

    /// How long an animation frame is lit.
    SessionDuration frame_period() const;
};

/// The scene of a protocol. Its meshes stay where they are: `objects` must outlive the result.
ObservedScene make_observed_scene(const Protocol& protocol, std::span<const Object> objects,
                                  const ScreenGeometry& screen);

/// Index of an area of the scene; -1 if gaze is not meant for it.
int area_in(const ObservedScene& scene, std::string_view area);

/// Pixels per degree at the middle of the screen, along each axis.
glm::dvec2 px_per_deg_at_centre(const ScreenGeometry& screen);

} // namespace overt
