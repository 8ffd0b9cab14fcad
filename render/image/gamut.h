/// Light that a display cannot show: counted, so that clipping is never silent.
#pragma once

#include <array>
#include <cstdint>

#include "render/image/linear_image.h"

namespace overt {

/// Pixels of the object (alpha above 0) whose light lies below the display's black or above its white, by
/// channel. The output clips them to 0 and 1, channel by channel.
struct ClippedPixels {
    std::int64_t object_pixels = 0;
    std::array<std::int64_t, 3> below{}, above{};

    ClippedPixels& operator+=(const ClippedPixels& other);
    double share_below(std::size_t channel) const;
    double share_above(std::size_t channel) const;
    bool any() const;
};

/// Over the background by the picture's alpha, as the encoder has it.
ClippedPixels count_clipped(const LinearImage& picture, double background);

} // namespace overt
