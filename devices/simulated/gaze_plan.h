/// What a simulated observer means to look at in a trial: the truth that an analysis should find.
#pragma once

#include <array>
#include <cstdint>

#include "devices/simulated/observed_scene.h"
#include "experiment/trial.h"

namespace overt {

/// Shares of the fixations after the first. What spots leave goes to areas or elsewhere.
struct GazePlan {
    struct Spot {
        int effect = 0; ///< index into ObservedScene::effects
        double share = 0.0;
    };
    /// Of those that go to no spot, by ObservedScene::areas; what they leave goes elsewhere.
    std::array<double, most_observed_areas> shares{};
    std::size_t area_count = 0;
    std::array<Spot, most_simulated_spots> spots{};
    int spot_count = 0;
    /// How far from the object's middle areas and elsewhere are looked at: a place at r times the usual
    /// distance is looked at as often as by area, times exp(spread r^2). 0: by area alone.
    double spread = 0.0;
};

/// The plan of an observer, who is known by the seed: the task's shares of areas, the odds of each times
/// those of all effects on it that hold in the trial, and on the scale of logits the observer's own
/// inclination to it, which is normal with the scene's standard deviation; then all shares are brought to a
/// sum of 1 with what goes elsewhere. Allocates nothing.
GazePlan gaze_plan(const ObservedScene& scene, std::uint64_t seed, int task, Stimulus stimulus) noexcept;

} // namespace overt
