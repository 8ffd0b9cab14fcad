/// What a stimulus takes in the frame store on the graphics card, before any of it is drawn.
#pragma once

#include <optional>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Columns of the screen, the last excluded.
struct ScreenColumns {
    int begin = 0, end = 0;
};

/// Whether pages are kept with 16 bits a channel, for the card to take the last step to the signal: of native
/// outputs with more than 8 bits, or with noise that is new in each refresh.
bool keeps_16_bits(const DisplaySettings& display);

/// How far a filter reaches beside a pair of pixels, in pixels.
int pair_reach_px(const DisplaySettings& display);

/// What of the screen a picture of `width_px` changes that begins in column `left_px`: whole pairs where
/// pixels are joined, and as far as the filter reaches.
ScreenColumns changed_columns(const DisplaySettings& display, int left_px, int width_px);

/// Of one page, which takes what the largest slot needs in columns and in rows: 4 bytes a pixel, or 8 with 16
/// bits a channel.
double page_bytes(const Protocol& protocol);

/// Pages of a stimulus: one for each picture of its motion, or for each frame that is ready-made.
int pages_of(const Protocol& protocol, const Stimulus& stimulus);

/// A stimulus of more pages than the frame store has room for comes from disk while it is shown, if there is
/// room for so many at least.
inline constexpr int least_streamed_pages = 8;

/// Pages of the shown stimulus that the frame store has room for at most.
int pages_with_room(const Protocol& protocol);

/// Whether stimuli in a motion come from disk while they are shown: not all of their pages fit, and they are
/// shown alone and in the order of the frames.
bool is_streamed(const Protocol& protocol, int motion);

/// Pages of the stimulus that has most, of all or of those in a motion.
int most_pages(const Protocol& protocol, std::optional<int> motion = {});

} // namespace overt
