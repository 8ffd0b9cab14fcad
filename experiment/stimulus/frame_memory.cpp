#include "experiment/stimulus/frame_memory.h"

#include <algorithm>
#include <cmath>

#include "experiment/animation.h"
#include "experiment/protocol/all_stimuli.h"
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
    const DisplaySettings display = display_of_field(protocol);
    const double eyes = protocol.stereo.is_on() ? 2.0 : 1.0;
    int columns = 0, rows = 0;
    for (const Slot& slot : protocol.slots) {
        const ScreenGeometry at = slot_geometry(protocol, slot);
        const ScreenColumns changed = changed_columns(display, at.image_origin_px.x, at.image_px.x);
        columns = std::max(columns, changed.end - changed.begin);
        rows = std::max(rows, at.image_px.y);
    }
    return eyes * static_cast<double>(columns) * rows * (keeps_16_bits(display) ? 8.0 : 4.0);
}

int pages_of(const Protocol& protocol, const Stimulus& stimulus) {
    const Animation& motion = protocol.motion_of(stimulus);
    return find_frames(protocol, stimulus) ? motion.frame_count : static_cast<int>(motion.pictures().size());
}

int pages_with_room(const Protocol& protocol) {
    return static_cast<int>(
        std::min(1e6, std::floor(1e6 * protocol.display.frame_store_mb / page_bytes(protocol))));
}

bool is_streamed(const Protocol& protocol, int motion) {
    const int room = pages_with_room(protocol);
    return most_pages(protocol, motion) > room && room >= least_streamed_pages &&
           protocol.slots.size() == 1 &&
           law_of(protocol.motions[static_cast<std::size_t>(motion)].kind).has_plan;
}

int most_pages(const Protocol& protocol, std::optional<int> motion) {
    int most = 0;
    for (const Stimulus& stimulus : all_stimuli(protocol)) {
        if (stimulus.motion == motion.value_or(stimulus.motion))
            most = std::max(most, pages_of(protocol, stimulus));
    }
    return most;
}

} // namespace overt
