/// The square in a corner of the screen that a photodiode looks at.
#pragma once

#include <optional>

#include "experiment/protocol/protocol.h"

namespace overt {

struct PatchPlace {
    glm::ivec2 origin_px{0}, size_px{0};
    glm::ivec2 end_px() const { return origin_px + size_px; }
};

/// Where it stands; nothing if the protocol has none. Below the rows that carry messages, and of whole pairs
/// where the output joins pixels in pairs (one wider than photodiode_px if that is odd).
std::optional<PatchPlace> photodiode_patch_of(const DisplaySettings& display);

/// So far must it be from the stimulus: no filter over pairs reaches farther.
inline constexpr int patch_distance_px = 12;

} // namespace overt
