/// Which patches are measured to characterise a display, and in which order.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace overt {

struct PatchPlanSettings {
    int levels = 17; ///< of each channel alone, black among them
    int mixed = 24;  ///< patches of random signals in all channels, for validation
    int repeats = 3; ///< of all of it
    std::uint64_t seed = 1;
};

/// Signals of red, green and blue, 0 … 1: black, each channel alone, white, pairs of full channels, steps of
/// each channel with the others lit, and random mixtures. Each repeat is in an order of its own, so that the
/// display's and the photometer's drift falls on all levels alike.
std::vector<glm::dvec3> plan_patches(const PatchPlanSettings& settings);

} // namespace overt
