/// The edges of a mesh with the triangles at each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "experiment/scene/mesh.h"

namespace overt {

/// An edge as one triangle has it.
struct TriangleSide {
    std::uint32_t higher_vertex; ///< of the edge's two
    std::uint32_t triangle;
    std::uint32_t corner; ///< the triangle's corner opposite the edge, 0 … 2
};

/// Calls visit(lower vertex, sides) for each edge, with one side for each triangle that has it. Edges come by
/// their lower vertex, sides by triangle. Linear in the size of the mesh; takes 36 bytes for each triangle
/// and 8 for each vertex meanwhile.
template <class Visit> void for_each_edge(const Mesh& mesh, const Visit& visit) {
    const auto for_each_side = [&](const auto& take) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = mesh.triangles[t][static_cast<int>((corner + 1) % 3)];
                const std::uint32_t b = mesh.triangles[t][static_cast<int>((corner + 2) % 3)];
                take(std::min(a, b), TriangleSide{std::max(a, b), t, corner});
            }
        }
    };
    // One bucket for each lower vertex. While they fill, each entry moves from its bucket's begin to its end.
    std::vector<std::size_t> bucket_end(mesh.positions.size() + 1, 0);
    for_each_side([&](std::uint32_t vertex, const TriangleSide&) { ++bucket_end[vertex + 1]; });
    for (std::size_t v = 1; v < bucket_end.size(); ++v)
        bucket_end[v] += bucket_end[v - 1];
    std::vector<TriangleSide> sides(3 * mesh.triangles.size());
    for_each_side(
        [&](std::uint32_t vertex, const TriangleSide& side) { sides[bucket_end[vertex]++] = side; });
    std::size_t begin = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const std::size_t bucket = bucket_end[v];
        std::stable_sort(
            sides.begin() + static_cast<std::ptrdiff_t>(begin),
            sides.begin() + static_cast<std::ptrdiff_t>(bucket),
            [](const TriangleSide& a, const TriangleSide& b) { return a.higher_vertex < b.higher_vertex; });
        while (begin < bucket) {
            std::size_t end = begin + 1;
            while (end < bucket && sides[end].higher_vertex == sides[begin].higher_vertex)
                ++end;
            visit(v, std::span<const TriangleSide>(sides).subspan(begin, end - begin));
            begin = end;
        }
    }
}

} // namespace overt
