/// Frames that another program has rendered.
#pragma once

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Throws InputError, naming the file, if one of the frames 0 … frame_count-1 is no picture of the size
/// wanted. Looks at the files' headers only.
void check_frame_sizes(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px);

/// The same, and reads every frame to its last pixel, on all processors: what passes can be shown.
void check_frame_pixels(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px);

} // namespace overt
