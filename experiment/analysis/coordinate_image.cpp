#include "experiment/analysis/coordinate_image.h"

#include <algorithm>

#include "experiment/parallel.h"

namespace overt {

namespace {

/// How many of the 3 x 3 pixels show a surface.
int covered_around(const TriangleMap& map, int x, int y) {
    int covered = 0;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx)
            covered += map.code_at(x + dx, y + dy) != 0;
    }
    return covered;
}

/// Where the line passes the triangle's plane, or beside the triangle the place of it that is nearest in
/// barycentric coordinates: the line passes it by less than a pixel's fraction.
glm::dvec3 place_on(const Mesh& mesh, std::uint32_t triangle, glm::dvec3 origin, glm::dvec3 direction) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    const glm::dvec3 to_a = a - origin, to_b = b - origin, to_c = c - origin;
    glm::dvec3 weights(glm::dot(direction, glm::cross(to_b, to_c)),
                       glm::dot(direction, glm::cross(to_c, to_a)),
                       glm::dot(direction, glm::cross(to_a, to_b)));
    const double sum = weights.x + weights.y + weights.z;
    weights = sum == 0.0 ? glm::dvec3(1.0) : glm::max(weights / sum, 0.0);
    weights /= weights.x + weights.y + weights.z;
    return weights.x * a + weights.y * b + weights.z * c;
}

} // namespace

std::size_t CoordinateImage::covered_pixels() const {
    return static_cast<std::size_t>(
        std::count_if(pixels.begin(), pixels.end(), [](const glm::vec4& pixel) { return pixel.w != 0.0f; }));
}

CoordinateImage coordinate_image(const SurfaceLookup& lookup, PoseIndex pose, const TriangleMap& map,
                                 const Mesh& mesh, const SightLines& sight) {
    CoordinateImage image(map.size_px);
    parallel_for(map.size_px.y, [&](int y) {
        for (int x = 0; x < map.size_px.x; ++x) {
            const int covered = covered_around(map, x, y);
            if (covered == 0)
                continue;
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const std::uint32_t code = map.code_at(x, y);
            if (const auto surface = lookup.surface_at(pose, centre)) {
                image.at(x, y) = glm::vec4(surface->position, 1.0f);
            } else if (covered == 9) {
                image.at(x, y) = glm::vec4(
                    place_on(mesh, code - 1, sight.origin(), sight.direction_through(centre)), 1.0f);
            }
        }
    });
    return image;
}

} // namespace overt
