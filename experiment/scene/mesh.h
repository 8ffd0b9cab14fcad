/// A triangle mesh in object coordinates: the object as it stands, unturned, +z up, its front towards -y.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// Axis-aligned box, in the mesh's unit.
struct Bounds {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};

    glm::dvec3 centre() const { return 0.5 * (min + max); }
    glm::dvec3 extent() const { return max - min; }
    double diagonal() const { return glm::length(extent()); }
};

/// Largest number of vertices that a mesh may have, so that an index fits 31 bits.
inline constexpr std::uint64_t max_mesh_vertices = 0x7fffffff;

/// Index into Mesh::part_names.
using PartIndex = std::uint8_t;

/// Positions, triangles and the part of the figure that each triangle belongs to.
struct Mesh {
    std::vector<glm::vec3> positions;      ///< in the mesh's unit
    std::vector<glm::uvec3> triangles;     ///< indices into positions, counter-clockwise seen from outside
    std::vector<PartIndex> triangle_parts; ///< one per triangle
    std::vector<std::string> part_names;   ///< never empty; {"body"} when the figure is not divided

    /// Box around all positions. A mesh without positions has the box {0, 0}.
    Bounds bounds() const;

    /// Area-weighted unit normal of each vertex, as long as positions; a vertex of no triangle gets +z.
    std::vector<glm::vec3> vertex_normals() const;

    /// Sum of the triangles' areas, in the square of the mesh's unit.
    double area() const;

    /// The same of each part, by PartIndex.
    std::vector<double> part_areas() const;
};

} // namespace overt
