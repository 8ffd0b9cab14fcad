#include "experiment/stimulus/photodiode_patch.h"

namespace overt {

std::optional<PatchPlace> photodiode_patch_of(const DisplaySettings& display) {
    if (display.photodiode == PatchCorner::none)
        return std::nullopt;
    const bool in_pairs = joins_pixels_in_pairs(display.output);
    PatchPlace place;
    place.size_px = glm::ivec2(display.photodiode_px);
    if (in_pairs)
        place.size_px.x += place.size_px.x % 2;
    const bool is_right =
        display.photodiode == PatchCorner::top_right || display.photodiode == PatchCorner::bottom_right;
    const bool is_low =
        display.photodiode == PatchCorner::bottom_left || display.photodiode == PatchCorner::bottom_right;
    place.origin_px.x = is_right ? display.width_px - place.size_px.x : 0;
    place.origin_px.y = is_low ? display.height_px - place.size_px.y : reserved_rows(display.output);
    return place;
}

} // namespace overt
