/// What a mesh file holds, before anything is turned, scaled or cleaned.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// Number that a file gives to a part of the figure; any value, in no particular order.
using PartLabel = std::int32_t;

/// Positions and triangles in the file's order and coordinates. Every index is below positions.size(), every
/// coordinate is finite, and there is at least one triangle. Polygons have become fans around their first
/// corner, which is right for convex ones.
struct RawMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<PartLabel> triangle_labels;      ///< one per triangle, or empty if the file labels nothing
    std::map<PartLabel, std::string> part_names; ///< names that the file gives to labels; may be empty
};

/// Largest number of vertices that a mesh may have, so that an index fits 31 bits.
inline constexpr std::uint64_t max_mesh_vertices = 0x7fffffff;

} // namespace overt
