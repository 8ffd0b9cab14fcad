#include "experiment/maps/visible_depth.h"

#include <algorithm>
#include <limits>

namespace overt {

namespace {

/// Depth at which a line of sight passes the plane of a triangle, but not before or behind its corners.
float depth_of(const WalkTriangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction,
               const glm::dvec3& forward) {
    const glm::dvec3 a = glm::dvec3(triangle.corners[0]) - origin,
                     b = glm::dvec3(triangle.corners[1]) - origin,
                     c = glm::dvec3(triangle.corners[2]) - origin;
    const glm::dvec3 depths(glm::dot(a, forward), glm::dot(b, forward), glm::dot(c, forward));
    const double nearest = std::min({depths.x, depths.y, depths.z}),
                 farthest = std::max({depths.x, depths.y, depths.z});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double depth = glm::dot(normal, a) / glm::dot(normal, direction);
    // Written so that what is not a number becomes the farthest.
    return static_cast<float>(depth >= nearest && depth <= farthest ? depth
                              : depth < nearest                     ? nearest
                                                                    : farthest);
}

struct Range {
    float nearest, farthest;
};

} // namespace

std::vector<float> farthest_visible_depths(const TriangleMap& map, const SightLines& lines,
                                           const SurfaceWalk& walk) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const auto width = static_cast<std::size_t>(map.size_px.x),
               height = static_cast<std::size_t>(map.size_px.y);
    const glm::dvec3 forward = lines.direction_through(0.5 * glm::dvec2(map.size_px));
    std::vector<float> depths(map.codes.size());
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const std::size_t column = i % width, row = i / width;
        const glm::dvec2 centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        depths[i] = map.codes[i] == 0 ? infinite
                                      : depth_of(walk.triangle(map.codes[i] - 1), lines.origin(),
                                                 lines.direction_through(centre), forward);
    }
    // Rows first, then columns; the image's border counts as background.
    std::vector<Range> ranges(depths.size(), {-infinite, infinite});
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 1; x + 1 < width; ++x) {
            const float* const here = &depths[y * width + x];
            ranges[y * width + x] = {std::min({here[-1], here[0], here[1]}),
                                     std::max({here[-1], here[0], here[1]})};
        }
    }
    std::fill(depths.begin(), depths.end(), infinite);
    for (std::size_t y = 1; y + 1 < height; ++y) {
        for (std::size_t x = 1; x + 1 < width; ++x) {
            const std::size_t i = y * width + x;
            const Range &above = ranges[i - width], &here = ranges[i], &below = ranges[i + width];
            const float farthest = std::max({above.farthest, here.farthest, below.farthest});
            const float nearest = std::min({above.nearest, here.nearest, below.nearest});
            if (farthest < infinite)
                depths[i] = farthest + (farthest - nearest);
        }
    }
    return depths;
}

} // namespace overt
