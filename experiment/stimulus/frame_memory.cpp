#include "experiment/stimulus/frame_memory.h"

#include <algorithm>

#include "experiment/animation.h"
#include "experiment/screen_geometry.h"

namespace overt {

bool keeps_16_bits(const DisplaySettings& display) {
    const OutputModeRow& mode = row_of(display.output);
    return !mode.is_packed && (mode.framebuffer_bits > 8 || display.dither != Dithering::none);
}

int pair_reach_px(const DisplaySettings& display) {
    return joins_pixels_in_pairs(display.output) && display.pair_filter == PairFilter::lanczos ? 6 : 0;
}

ScreenColumns changed_columns(const DisplaySettings& display, int left_px, int width_px) {
    if (!joins_pixels_in_pairs(display.output))
        return {left_px, left_px + width_px};
    // Pairs count from the left edge of the screen, and there is nothing beyond its edges.
    const int reach = pair_reach_px(display);
    return {std::max(0, left_px - reach) & ~1,
            std::min(display.width_px, (left_px + width_px + reach + 1) & ~1)};
}

double page_bytes(const Protocol& protocol) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const ScreenColumns columns =
        changed_columns(protocol.display, geometry.image_origin_px.x, geometry.image_px.x);
    return static_cast<double>(columns.end - columns.begin) * geometry.image_px.y *
           (keeps_16_bits(protocol.display) ? 8.0 : 4.0);
}

int most_pages(const Protocol& protocol) {
    int most = 0;
    const int poses = static_cast<int>(distinct_poses(protocol.motions.front()).angles.size());
    for (int object = 0; object < static_cast<int>(protocol.objects.size()); ++object) {
        for (int material = 0; material < static_cast<int>(protocol.materials.size()); ++material)
            most = std::max(
                most, find_frames(protocol, object, material) ? protocol.motions.front().frame_count : poses);
    }
    return most;
}

} // namespace overt
