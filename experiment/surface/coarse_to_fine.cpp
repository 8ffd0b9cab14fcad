#include "experiment/surface/coarse_to_fine.h"

#include <algorithm>
#include <limits>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// Share of b of the closest point between a and b.
double closest_on_side(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const double squared = glm::dot(b - a, b - a);
    return squared > 0.0 ? std::clamp(glm::dot(point - a, b - a) / squared, 0.0, 1.0) : 0.0;
}

} // namespace

glm::dvec3 closest_in_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double squared = glm::dot(normal, normal);
    if (squared > 0.0) {
        const glm::dvec3 inside(glm::dot(glm::cross(c - b, point - b), normal) / squared,
                                glm::dot(glm::cross(a - c, point - c), normal) / squared,
                                glm::dot(glm::cross(b - a, point - a), normal) / squared);
        if (inside.x >= 0.0 && inside.y >= 0.0 && inside.z >= 0.0)
            return inside;
    }
    // Beside it, the closest point lies on one of its sides.
    const glm::dvec3 corners[3] = {a, b, c};
    glm::dvec3 best{1.0, 0.0, 0.0};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const double share = closest_on_side(point, corners[k], corners[next]);
        const double away = glm::distance(point, glm::mix(corners[k], corners[next], share));
        if (away < least) {
            least = away;
            best = glm::dvec3(0.0);
            best[k] = 1.0 - share;
            best[next] = share;
        }
    }
    return best;
}

CoarseToFine::CoarseToFine(const CoarseSurface& coarse, const SurfaceGeometry& fine) {
    const Mesh& mesh = coarse.mesh();
    std::vector<std::vector<std::uint32_t>> triangles_at(coarse.vertex_count());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k)
            triangles_at[mesh.triangles[t][k]].push_back(t);
    }
    std::vector<Place> of_node(fine.node_count());
    constexpr std::size_t at_a_time = 4096;
    const auto turns = static_cast<int>((of_node.size() + at_a_time - 1) / at_a_time);
    parallel_for(turns, [&](int turn) {
        const std::size_t begin = static_cast<std::size_t>(turn) * at_a_time;
        for (std::size_t node = begin; node < std::min(of_node.size(), begin + at_a_time); ++node) {
            const glm::dvec3 point = fine.node_positions_mm()[node];
            const std::uint32_t vertex = coarse.vertex_near(static_cast<std::uint32_t>(node));
            of_node[node].corners = glm::uvec3(vertex);
            double least = std::numeric_limits<double>::infinity();
            const auto look_around = [&](std::uint32_t centre) {
                bool is_better = false;
                for (const std::uint32_t t : triangles_at[centre]) {
                    const glm::uvec3& corners = mesh.triangles[t];
                    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
                        c(mesh.positions[corners.z]);
                    const glm::dvec3 shares = closest_in_triangle(point, a, b, c);
                    const double away = glm::distance(point, shares.x * a + shares.y * b + shares.z * c);
                    if (away < least) {
                        is_better = true;
                        least = away;
                        of_node[node] = {corners, glm::vec3(shares)};
                    }
                }
                return is_better;
            };
            // From triangle to neighbouring triangle for as long as one is nearer.
            bool goes_on = look_around(vertex);
            for (int step = 0; goes_on && step < 8; ++step) {
                goes_on = false;
                const Place from = of_node[node];
                for (int k = 0; k < 3; ++k)
                    goes_on |= from.corners[k] != vertex && look_around(from.corners[k]);
            }
        }
    });
    for (std::uint32_t v = 0; v < fine.vertex_count(); ++v) {
        places_.push_back(of_node[fine.node_of(v)]);
        nearest_.push_back(coarse.vertex_near(fine.node_of(v)));
    }
}

std::vector<float> CoarseToFine::at_vertices(std::span<const float> of_coarse) const {
    std::vector<float> values;
    values.reserve(places_.size());
    for (const Place& place : places_)
        values.push_back(place.shares.x * of_coarse[place.corners.x] +
                         place.shares.y * of_coarse[place.corners.y] +
                         place.shares.z * of_coarse[place.corners.z]);
    return values;
}

} // namespace overt
