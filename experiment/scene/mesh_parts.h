/// Which part of the figure each triangle belongs to: by regions of space, or by labels of the mesh file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/raw_mesh.h"

namespace overt {

/// One side of a plane.
struct HalfSpace {
    glm::dvec3 point{0.0};            ///< on the plane
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< towards the side that is meant; any length but 0

    /// The plane itself is part of it.
    bool contains(const glm::dvec3& position) const { return glm::dot(position - point, normal) >= 0.0; }
};

/// A region of space, in the coordinates of the mesh that it is applied to: the union of its spheres, cut by
/// every half-space. Without spheres it is what the half-spaces have in common.
struct PartRegion {
    std::string name;                ///< of the part
    std::vector<glm::dvec4> spheres; ///< x, y, z of the centre, and the radius
    std::vector<HalfSpace> half_spaces;

    bool contains(const glm::dvec3& position) const;
};

/// Most parts that a mesh can have.
inline constexpr std::size_t max_mesh_parts = 256;

/// Gives each triangle the part of the first region that contains its centroid, or else the part `rest_name`,
/// which is part 0. Regions with the same name are one part. What the mesh's parts were before is forgotten.
///
/// The regions must be in the mesh's coordinates. A region noted in a file's coordinates is applied before
/// the mesh is turned and scaled, which import_mesh does.
///
/// Throws InputError if a region has no name, neither spheres nor half-spaces, a radius that is not positive,
/// a normal of length 0 or a number that is not finite; if it contains no triangle, as happens when it is
/// given in other coordinates; and for more than max_mesh_parts parts.
void label_parts(Mesh& mesh, std::span<const PartRegion> regions, std::string_view rest_name = "body");

/// The mesh with the parts that its file labels, in ascending order of the labels, named as in the file or
/// else "part LABEL". Named labels of no triangle are parts too. A file without labels, or with a single one
/// that has no name, gives the one part "body". Throws InputError for more than max_mesh_parts parts.
Mesh mesh_with_labelled_parts(RawMesh raw);

} // namespace overt
