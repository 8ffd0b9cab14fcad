#include "render/ready_made_frames.h"

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/parallel.h"
#include "render/linear_image.h"

namespace overt {

void check_frame_sizes(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px) {
    for (int frame = 0; frame < frame_count; ++frame) {
        const std::filesystem::path file = frame_file(sequence, {frame});
        const glm::ivec2 size = image_size_px(file);
        if (size != image_px) {
            throw InputError(fmt::format(
                "{}: is {} x {} pixels, but [view] asks for {} x {}: correct width_px and height_px, "
                "or the frames; they are never resized",
                file.string(), size.x, size.y, image_px.x, image_px.y));
        }
    }
}

void check_frame_pixels(const FrameSequenceSettings& sequence, int frame_count, glm::ivec2 image_px) {
    check_frame_sizes(sequence, frame_count, image_px);
    parallel_for(frame_count,
                 [&](int frame) { read_linear_image(frame_file(sequence, {frame}), sequence.encoding); });
}

} // namespace overt
