#include "experiment/scene/mesh_topology.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "experiment/base/error.h"

namespace overt {
namespace {

// The two ends of the edge that leaves the given corner.
struct DirectedEdge {
    std::uint32_t from, to;
    std::uint32_t lower() const { return std::min(from, to); }
    /// The upper end, and in the lowest bit whether the edge goes upwards.
    std::uint32_t upper_and_direction() const { return std::max(from, to) << 1 | (from < to ? 1u : 0u); }
};

DirectedEdge edge_of(const glm::uvec3& triangle, int corner) {
    return {triangle[corner], triangle[(corner + 1) % 3]};
}

// Counts the edges to one lower end, given the sorted upper ends with their directions.
void count_fan(std::span<const std::uint32_t> sorted, EdgeCounts& counts) {
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin;
        while (end < sorted.size() && sorted[end] >> 1 == sorted[begin] >> 1)
            ++end;
        ++counts.edges;
        if (end - begin == 1)
            ++counts.boundary;
        if (end - begin > 2)
            ++counts.non_manifold;
        if (end - begin == 2 && sorted[begin] == sorted[begin + 1])
            ++counts.conflicting;
        begin = end;
    }
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

} // namespace

// Edges are sorted into one bin for each vertex, their lower end: bins are small, so this is fast, and needs
// no more than the upper ends themselves.
EdgeCounts count_edges(std::span<const glm::uvec3> triangles, std::size_t vertex_count) {
    OVERT_EXPECTS(vertex_count <= max_mesh_vertices);
    std::vector<std::size_t> bin_ends(vertex_count + 1, 0);
    for (const glm::uvec3& triangle : triangles) {
        for (int corner = 0; corner < 3; ++corner)
            ++bin_ends[edge_of(triangle, corner).lower()];
    }
    std::exclusive_scan(bin_ends.begin(), bin_ends.end(), bin_ends.begin(), std::size_t{0});
    std::vector<std::uint32_t> upper_ends(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const DirectedEdge edge = edge_of(triangle, corner);
            upper_ends[bin_ends[edge.lower()]++] = edge.upper_and_direction();
        }
    }
    EdgeCounts counts;
    std::size_t begin = 0;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::span bin(upper_ends.data() + begin, bin_ends[vertex] - begin);
        std::sort(bin.begin(), bin.end());
        count_fan(bin, counts);
        begin = bin_ends[vertex];
    }
    return counts;
}

std::size_t count_components(std::span<const glm::uvec3> triangles, std::size_t vertex_count) {
    std::vector<std::uint32_t> parents(vertex_count);
    std::iota(parents.begin(), parents.end(), 0u);
    std::vector<bool> used(vertex_count, false);
    for (const glm::uvec3& triangle : triangles) {
        const std::uint32_t root = root_of(parents, triangle.x);
        parents[root_of(parents, triangle.y)] = root;
        parents[root_of(parents, triangle.z)] = root;
        used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
    }
    std::size_t components = 0;
    for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
        if (used[vertex] && parents[vertex] == vertex)
            ++components;
    }
    return components;
}

double signed_volume(const Mesh& mesh) {
    // About the centre, where the sum's terms are small and a hole's cone is short.
    const glm::dvec3 centre = mesh.bounds().centre();
    double six_volumes = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[triangle.x]) - centre;
        const glm::dvec3 b = glm::dvec3(mesh.positions[triangle.y]) - centre;
        const glm::dvec3 c = glm::dvec3(mesh.positions[triangle.z]) - centre;
        six_volumes += glm::dot(a, glm::cross(b, c));
    }
    return six_volumes / 6.0;
}

} // namespace overt
