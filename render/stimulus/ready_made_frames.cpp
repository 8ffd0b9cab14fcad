#include "render/stimulus/ready_made_frames.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "render/image/linear_image.h"

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

std::optional<std::vector<std::uint8_t>> object_pixels(const FrameSequenceSettings& sequence,
                                                       AnimationFrameIndex frame) {
    const std::filesystem::path file = frame_file(sequence, frame);
    const auto& background = sequence.background_colour;
    if (!background && !has_alpha(file))
        return std::nullopt;
    // Colours as they stand in the file: no encoding is undone.
    const LinearImage picture = read_linear_image(file);
    std::vector<std::uint8_t> object;
    object.reserve(picture.pixels.size());
    for (const glm::vec4& pixel : picture.pixels) {
        const auto differs = [&](int channel) {
            return std::abs(static_cast<double>(pixel[channel]) - (*background)[channel]) >
                   sequence.background_tolerance;
        };
        object.push_back(background ? differs(0) || differs(1) || differs(2) : pixel.w >= 0.5f);
    }
    return object;
}

} // namespace overt
