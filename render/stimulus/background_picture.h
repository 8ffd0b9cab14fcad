/// What the image of a stimulus shows where the object does not.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/image/linear_image.h"

namespace overt {

/// Whether it is the display's own background, which frames leave to whoever shows them.
inline bool is_displays_own(const BackgroundSettings& background) {
    return !background.grey && !background.colour && background.picture.empty();
}

/// The background of an image, opaque, in the display's light. A picture is read, brought to the display's
/// colours and made as large as it must be to cover the image, about its middle: each pixel is the mean of
/// what it covers of the picture, or lies between its pixels where they are larger (bilinear). Of the
/// display's own it is the display's grey. Throws InputError as read_linear_image does.
LinearImage draw_background(const BackgroundSettings& background, glm::ivec2 image_px,
                            const DisplaySettings& display);

/// Puts a picture whose colours are multiplied by alpha before an opaque one of the same size.
void put_before(LinearImage& picture, const LinearImage& background);

/// Of all that it is drawn from. Throws InputError if a file cannot be read.
ContentHash hash_of_background(const BackgroundSettings& background);

} // namespace overt
