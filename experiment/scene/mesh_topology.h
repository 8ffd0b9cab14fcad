/// How the triangles of a mesh hang together: edges, pieces, inside and outside.
#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

/// The undirected edges of a mesh, by the number of triangles at each.
struct EdgeCounts {
    std::size_t edges = 0;
    std::size_t boundary = 0;     ///< with one triangle: the rim of a hole
    std::size_t non_manifold = 0; ///< with three or more
    std::size_t conflicting = 0;  ///< with two that go along it in the same direction: their fronts disagree

    /// Every edge has two triangles.
    bool is_closed() const { return boundary == 0 && non_manifold == 0; }
    /// Closed, and all fronts face the same way: the mesh bounds a volume.
    bool bounds_volume() const { return is_closed() && conflicting == 0; }
};

/// Counts the edges. The three corners of a triangle must differ and be below vertex_count, which is at most
/// max_mesh_vertices. Takes 12 bytes for each triangle and 8 for each vertex meanwhile.
EdgeCounts count_edges(std::span<const glm::uvec3> triangles, std::size_t vertex_count);

/// Number of pieces: triangles belong to the same piece if they share a vertex. Vertices of no triangle do
/// not count.
std::size_t count_components(std::span<const glm::uvec3> triangles, std::size_t vertex_count);

/// Volume that the triangles enclose, in the cube of the mesh's unit; negative if they face inwards. For a
/// mesh that is not closed, each hole is covered by a cone to the centre of the bounding box.
double signed_volume(const Mesh& mesh);

} // namespace overt
