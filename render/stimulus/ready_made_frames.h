/// Frames that another program has rendered.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Throws InputError, naming the file, if one of the frames 0 … frame_count-1 is no picture of the size
/// wanted. Looks at the files' headers only.
void check_frame_sizes(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px);

/// The same, and reads every frame to its last pixel, on all processors: what passes can be shown.
void check_frame_pixels(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px);

/// A byte for each pixel of a frame, not 0 where it shows the object: where its colour is not the sequence's
/// background, or else where alpha is at least 1/2. Nothing if the sequence gives no background colour and
/// the file has no alpha. Throws InputError if the file cannot be read.
std::optional<std::vector<std::uint8_t>> object_pixels(const FrameSequenceSettings& sequence,
                                                       AnimationFrameIndex frame);

} // namespace overt
