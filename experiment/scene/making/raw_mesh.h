/// What a mesh file holds, before anything is turned, scaled or cleaned.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/surface_appearance.h"

namespace overt {

/// Whether a mesh file is read for its shape alone, or also for how its surface looks.
enum class MeshWanted : std::uint8_t { shape, appearance };

/// Number that a file gives to a part of the figure; any value, in no particular order.
using PartLabel = std::int32_t;

/// Positions and triangles in the file's order and coordinates. Every index is below positions.size(), every
/// coordinate of a vertex that a triangle uses is finite and fits a 32-bit float, and there is at least one
/// triangle. Faces of more corners have become as many triangles as they have corners, less two
/// (face_cutting.h). Positions are doubles, since a file may have its mesh far from the origin.
struct RawMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<PartLabel> triangle_labels;      ///< one per triangle, or empty if the file labels nothing
    std::map<PartLabel, std::string> part_names; ///< names that the file gives to labels; may be empty
    bool are_areas_labelled = false; ///< by an attribute that is there for it, and not by groups or nodes
    /// What the triangles are made of, as an index into material_names for each; empty if the file does not
    /// say.
    std::vector<std::uint16_t> triangle_materials;
    std::vector<std::string> material_names;
    /// How the surface looks, if that was asked for; its triangle_materials are left to the above.
    SurfaceAppearance appearance;
    std::vector<std::string> remarks; ///< what the file holds that is left aside
    std::size_t crossing_faces = 0;   ///< whose outline crosses itself, so that they have no inside
};

/// Whether a number of a mesh file can be a coordinate: finite, and no larger than a 32-bit float can be.
inline bool is_coordinate(double value) { return std::abs(value) <= std::numeric_limits<float>::max(); }

/// The first vertex that a triangle uses and that has no place: a coordinate that can be none.
std::optional<std::size_t> first_used_without_place(const RawMesh& mesh);

struct UnusedVertices {
    std::size_t with_place = 0, without_place = 0;
};
/// Drops the vertices that no triangle uses, with all that they could have to do with the mesh's box.
UnusedVertices drop_unused_vertices(RawMesh& mesh);

} // namespace overt
