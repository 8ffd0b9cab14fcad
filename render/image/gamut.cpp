#include "render/image/gamut.h"

#include <algorithm>

namespace overt {

namespace {

double share(std::int64_t count, std::int64_t of) {
    return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0.0;
}

} // namespace

ClippedPixels& ClippedPixels::operator+=(const ClippedPixels& other) {
    object_pixels += other.object_pixels;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        below[channel] += other.below[channel];
        above[channel] += other.above[channel];
    }
    return *this;
}

double ClippedPixels::share_below(std::size_t channel) const { return share(below[channel], object_pixels); }
double ClippedPixels::share_above(std::size_t channel) const { return share(above[channel], object_pixels); }

bool ClippedPixels::any() const {
    const auto is_some = [](std::int64_t count) { return count > 0; };
    return std::any_of(below.begin(), below.end(), is_some) ||
           std::any_of(above.begin(), above.end(), is_some);
}

ClippedPixels count_clipped(const LinearImage& picture, double background) {
    ClippedPixels clipped;
    for (const glm::vec4& pixel : picture.pixels) {
        if (!(pixel.w > 0.0f))
            continue;
        ++clipped.object_pixels;
        for (int channel = 0; channel < 3; ++channel) {
            const double light = double{pixel[channel]} + (1.0 - double{pixel.w}) * background;
            clipped.below[static_cast<std::size_t>(channel)] += light < 0.0;
            clipped.above[static_cast<std::size_t>(channel)] += light > 1.0;
        }
    }
    return clipped;
}

} // namespace overt
