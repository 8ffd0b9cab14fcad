#include "experiment/maps/surface_walk.h"

#include "experiment/maps/mesh_edges.h"

namespace overt {

namespace {

/// Steps before a line is given up; a pixel is seldom more than a few triangles wide.
constexpr int longest_walk = 24;

} // namespace

SurfaceWalk::SurfaceWalk(const Mesh& mesh) : triangles_(mesh.triangles.size()) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner)
            triangles_[t].corners[static_cast<std::size_t>(corner)] =
                mesh.positions[mesh.triangles[t][corner]];
        triangles_[t].part = mesh.triangle_parts[t];
    }
    for_each_edge(mesh, [&](std::uint32_t, std::span<const TriangleSide> sides) {
        if (sides.size() != 2)
            return;
        triangles_[sides[0].triangle].neighbours[sides[0].corner] = sides[1].triangle;
        triangles_[sides[1].triangle].neighbours[sides[1].corner] = sides[0].triangle;
    });
}

bool SurfaceWalk::meet(std::uint32_t start, const glm::dvec3& origin, const glm::dvec3& direction,
                       Meeting& meeting) const {
    std::uint32_t triangle = start, came_from = no_triangle;
    bool front_seen = false;
    for (int step = 0; step < longest_walk; ++step) {
        const WalkTriangle& here = triangles_[triangle];
        const glm::dvec3 a = glm::dvec3(here.corners[0]) - origin;
        const glm::dvec3 b = glm::dvec3(here.corners[1]) - origin;
        const glm::dvec3 c = glm::dvec3(here.corners[2]) - origin;
        // Volumes spanned by the line and each edge: all of one sign where it passes inside.
        const double of_a = glm::dot(direction, glm::cross(b, c)),
                     of_b = glm::dot(direction, glm::cross(c, a)),
                     of_c = glm::dot(direction, glm::cross(a, b));
        const double sum = of_a + of_b + of_c;
        if (sum == 0.0 || (step > 0 && (sum > 0.0) != front_seen))
            return false; // seen edge-on, or turned away
        front_seen = sum > 0.0;
        const double per_sum = 1.0 / sum;
        const glm::dvec3 weights(of_a * per_sum, of_b * per_sum, of_c * per_sum);
        if (weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0) {
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double depth = glm::dot(normal, a) / glm::dot(normal, direction);
            meeting.triangle = triangle;
            meeting.barycentric = weights;
            meeting.depth = depth;
            return depth > 0.0;
        }
        // Across the edge that it passes farthest outside, but not back to where the walk came from.
        std::uint32_t next = no_triangle;
        double farthest = 0.0;
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t neighbour = here.neighbours[static_cast<std::size_t>(corner)];
            if (weights[corner] < farthest && neighbour != no_triangle && neighbour != came_from) {
                farthest = weights[corner];
                next = neighbour;
            }
        }
        if (next == no_triangle)
            return false;
        came_from = triangle;
        triangle = next;
    }
    return false;
}

} // namespace overt
