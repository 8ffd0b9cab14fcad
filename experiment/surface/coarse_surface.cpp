#include "experiment/surface/coarse_surface.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include <meshoptimizer.h>

namespace overt {
namespace {

constexpr auto no_vertex = std::numeric_limits<std::uint32_t>::max();

// Corners of all triangles that name three nodes.
std::vector<unsigned> indices_of(const SurfaceGeometry& geometry) {
    std::vector<unsigned> indices;
    indices.reserve(3 * geometry.triangle_count());
    for (std::uint32_t t = 0; t < geometry.triangle_count(); ++t) {
        const glm::uvec3& corners = geometry.corners(t);
        if (corners.x != corners.y && corners.y != corners.z && corners.z != corners.x)
            indices.insert(indices.end(), {corners.x, corners.y, corners.z});
    }
    return indices;
}

} // namespace

CoarseSurface::CoarseSurface(const SurfaceGeometry& fine, std::size_t most_nodes, double size) : fine_(fine) {
    const std::span<const glm::dvec3> nodes = fine.node_positions_mm();
    std::vector<glm::vec3> positions;
    positions.reserve(nodes.size());
    for (const glm::dvec3& node : nodes)
        positions.emplace_back(size * node);
    std::vector<unsigned> indices = indices_of(fine);
    if (nodes.size() > most_nodes && !indices.empty()) {
        // A closed surface has twice as many triangles as nodes.
        const std::size_t wanted = std::min(indices.size(), 6 * most_nodes);
        std::vector<unsigned> fewer(indices.size());
        fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), &positions[0].x,
                                      positions.size(), sizeof(glm::vec3), wanted, 1.0f));
        if (!fewer.empty())
            indices = std::move(fewer);
    }
    std::vector<std::uint32_t> vertex_of(nodes.size(), no_vertex);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        std::uint32_t& vertex = vertex_of[indices[i]];
        if (vertex == no_vertex) {
            vertex = static_cast<std::uint32_t>(node_of_vertex_.size());
            node_of_vertex_.push_back(indices[i]);
            mesh_.positions.emplace_back(nodes[indices[i]]);
            places_.push_back({static_cast<std::uint32_t>(i / 3), glm::dvec3(0.0)});
            places_.back().barycentric[static_cast<int>(i % 3)] = 1.0;
        }
        if (i % 3 == 2)
            mesh_.triangles.emplace_back(vertex_of[indices[i - 2]], vertex_of[indices[i - 1]], vertex);
    }
    mesh_.triangle_parts.assign(mesh_.triangles.size(), PartIndex{0});
    mesh_.part_names = {"body"};
    vertex_near_ = std::move(vertex_of);
    find_nearest();
}

// Dijkstra's distances along the edges from all kept nodes at once.
void CoarseSurface::find_nearest() {
    using Candidate = std::tuple<double, std::uint32_t, std::uint32_t>; // distance, node, vertex
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open;
    const std::span<const glm::dvec3> positions = fine_.node_positions_mm();
    std::vector<double> distance(positions.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t vertex = 0; vertex < node_of_vertex_.size(); ++vertex) {
        distance[node_of_vertex_[vertex]] = 0.0;
        open.emplace(0.0, node_of_vertex_[vertex], vertex);
    }
    while (!open.empty()) {
        const auto [away, node, vertex] = open.top();
        open.pop();
        if (away > distance[node] || (vertex_near_[node] != no_vertex && vertex_near_[node] != vertex))
            continue;
        vertex_near_[node] = vertex;
        for (const std::uint32_t next : fine_.neighbours(node)) {
            const double to_next = away + glm::distance(positions[node], positions[next]);
            if (to_next < distance[next]) {
                distance[next] = to_next;
                open.emplace(to_next, next, vertex);
            }
        }
    }
    // What hangs together with no kept node: crumbs that were simplified away.
    for (std::uint32_t node = 0; node < vertex_near_.size(); ++node) {
        if (vertex_near_[node] != no_vertex || node_of_vertex_.empty())
            continue;
        const auto away = [&](std::uint32_t kept) { return glm::distance(positions[node], positions[kept]); };
        const auto nearest = std::min_element(node_of_vertex_.begin(), node_of_vertex_.end(),
                                              [&](auto a, auto b) { return away(a) < away(b); });
        vertex_near_[node] = static_cast<std::uint32_t>(nearest - node_of_vertex_.begin());
    }
}

std::array<SurfaceWeight, 3> CoarseSurface::moved(const SurfaceWeight& weight) const {
    const glm::uvec3& corners = fine_.corners(weight.place.triangle);
    std::array<SurfaceWeight, 3> weights;
    for (int k = 0; k < 3; ++k)
        weights[static_cast<std::size_t>(k)] = {places_[vertex_near_[corners[k]]],
                                                weight.weight * weight.place.barycentric[k], weight.sigma_mm};
    return weights;
}

} // namespace overt
