/// What a simulated observer can look at, and how its light reaches the eye.
#pragma once

#include <array>
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

/// An object in a view.
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

/// What the gaze depends on besides the task.
struct ObservedEffect {
    int task = -1; ///< -1: any
    /// For each list, whether it holds for each entry.
    std::array<std::vector<bool>, stimulus_lists.size()> entries;
    int area = 0; ///< index into ObservedScene::areas
    double odds = 1.0, spot_share = 0.0;
    double spread = 0.0; ///< see GazePlan

    bool holds_in(int of_task, Stimulus stimulus) const {
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
            if (const int entry = stimulus.*stimulus_lists[list].index;
                !entries[list].empty() && !entries[list][static_cast<std::size_t>(entry)])
                return false;
        return task < 0 || task == of_task;
    }
};

struct ObservedScene {
    ScreenGeometry screen;
    std::vector<Animation> animations = std::vector<Animation>(1); ///< by Stimulus::motion
    double refresh_hz = 120.0;
    SessionDuration display_latency{};                      ///< from vertical blank to the first row's light
    std::vector<ObservedObject> objects;                    ///< see index_of(): each object in each view
    int views = 1;                                          ///< at all sizes that slots have, of both eyes
    int first_view = 0;                                     ///< of the eye that is analysed
    std::vector<std::string> areas{std::string(head_area)}; ///< that gaze is meant for, without overlap
    std::vector<ObservedTask> tasks;                        ///< by Trial::task
    std::vector<ObservedEffect> effects = {};
    double share_sd = 0.0;                  ///< of the logit of each area's share, over observers
    std::vector<ScreenGeometry> slots = {}; ///< the screen with each slot's image; none: `screen` alone
    std::vector<int> slot_views = {};       ///< by slot: from which view on are those of its size; none: 0
    double longest_step_s = 0.0; ///< of the steps of tasks that show something for a time of their own

    const ScreenGeometry& screen_of_slot(int slot) const {
        return slots.empty() ? screen : slots[static_cast<std::size_t>(slot)];
    }

    /// From vertical blank to the light of a row: rows are lit one after another, evenly over one refresh.
    /// Rows above and below the screen are taken as its first and last.
    SessionDuration light_delay(double y_px) const;

    /// How long a frame of a motion is lit.
    SessionDuration frame_period(int motion) const;

    const Animation& animation_of(int motion) const { return animations[static_cast<std::size_t>(motion)]; }
    /// Of the longest show that there is.
    double longest_s() const;
    /// Where `objects` has what is seen of a stimulus in its slot.
    std::size_t index_of(const PlacedStimulus& shown) const {
        const auto slot = static_cast<std::size_t>(shown.slot);
        const int view = first_view + shown.stimulus.view + (slot < slot_views.size() ? slot_views[slot] : 0);
        return static_cast<std::size_t>(shown.stimulus.object) * static_cast<std::size_t>(views) +
               static_cast<std::size_t>(view);
    }
};

/// The scene of a protocol. Its meshes stay where they are: `objects` must outlive the result.
ObservedScene make_observed_scene(const Protocol& protocol, std::span<const Object> objects,
                                  const ScreenGeometry& screen);

/// Index of an area of the scene; -1 if gaze is not meant for it.
int area_in(const ObservedScene& scene, std::string_view area);

/// Pixels per degree at the middle of the screen, along each axis.
glm::dvec2 px_per_deg_at_centre(const ScreenGeometry& screen);

} // namespace overt
