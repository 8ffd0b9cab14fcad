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

/// How what an observer is going to answer changes where they look before.
struct GazeFavour {
    int slot = -1;      ///< index into the protocol's, that is looked at more, or less, than others; -1: none
    double share = 0.0; ///< of the fixations, on it
    int area = -1;      ///< of ObservedScene::areas; -1: none
    double odds = 1.0;  ///< times those of a fixation on that area
};
/// Multiplies the odds of the area in a plan; what it gains all other shares lose in proportion.
void favour_area(GazePlan& plan, const GazeFavour& favour) noexcept;

/// The plan of an observer, who is known by the seed: the task's shares of areas, the odds of each times
/// those of all effects on it that hold in the trial, and on the scale of logits the observer's own
/// inclination to it, which is normal with the scene's standard deviation; then all shares are brought to a
/// sum of 1 with what goes elsewhere. Allocates nothing.
GazePlan gaze_plan(const ObservedScene& scene, std::uint64_t seed, int task, Stimulus stimulus) noexcept;

} // namespace overt
