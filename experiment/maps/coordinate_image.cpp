#include "experiment/maps/coordinate_image.h"

#include <algorithm>

#include "experiment/base/parallel.h"

namespace overt {

std::size_t CoordinateImage::covered_pixels() const {
    return static_cast<std::size_t>(
        std::count_if(pixels.begin(), pixels.end(), [](const glm::vec4& pixel) { return pixel.w != 0.0f; }));
}

CoordinateImage coordinate_image(const SurfaceLookup& lookup, PoseIndex pose, glm::ivec2 size_px) {
    CoordinateImage image(size_px);
    parallel_for(size_px.y, [&](int y) {
        for (int x = 0; x < size_px.x; ++x) {
            if (const auto surface = lookup.surface_at(pose, {x + 0.5, y + 0.5}))
                image.at(x, y) = glm::vec4(surface->position, 1.0f);
        }
    });
    return image;
}

} // namespace overt
