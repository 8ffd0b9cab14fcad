/// Which areas each triangle belongs to: by regions of space, and by labels of the mesh file.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/making/raw_mesh.h"
#include "experiment/scene/mesh.h"

namespace overt {

/// One side of a plane.
struct HalfSpace {
    glm::dvec3 point{0.0};            ///< on the plane
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< towards the side that is meant; any length but 0

    /// The plane itself is part of it.
    bool contains(const glm::dvec3& position) const { return glm::dot(position - point, normal) >= 0.0; }
};

/// Where an area is, in the coordinates of the mesh that it is applied to: what lies in any of its spheres,
/// boxes and groups, cut by every half-space. Without any of the three it is what the half-spaces have in
/// common.
struct PartRegion {
    std::string name;                ///< of the area
    std::vector<glm::dvec4> spheres; ///< x, y, z of the centre, and the radius
    std::vector<HalfSpace> half_spaces;
    std::vector<std::array<glm::dvec3, 2>> boxes = {}; ///< corners with the smallest and the largest
    std::vector<std::string> groups = {};              ///< names of parts that the mesh has

    /// `part`: that the place has in the mesh.
    bool contains(const glm::dvec3& position, std::string_view part = {}) const;
};

/// Most parts that a mesh can have.
inline constexpr std::size_t max_mesh_parts = 256;

/// Most areas that can be described beside those of the mesh file.
inline constexpr std::size_t most_regions = 64;

/// Areas that are described in ways that cannot be.
class AreaError : public InputError {
  public:
    struct Fault {
        std::string area, message; ///< whole sentence
    };
    explicit AreaError(std::vector<Fault> faults);
    /// The same with the file before what is said of all together.
    AreaError(const std::string& file, const AreaError& error);
    const std::vector<Fault>& faults() const { return faults_; }

  private:
    std::vector<Fault> faults_;
};

/// Adds areas to those that the mesh has (areas.h): a triangle belongs to each region that contains its
/// centroid and, where the mesh was divided, to the part that it had. Regions of the same name are one area.
/// What no region takes of a mesh that was not divided stays "body".
///
/// `places` are those of the vertices in the coordinates in which the regions are given; empty: the mesh's
/// own. A region noted in a file's coordinates is applied before the mesh is turned and scaled, which
/// import_mesh does. Gives a sentence for each name that a label and a region share.
///
/// Throws AreaError, for all regions at once, if one has no name, one with a slash, or nothing that says
/// where it is, a group that the mesh does not have, a radius that is not positive, a box without an inside,
/// a normal of length 0 or a number that is not finite; if it contains no triangle, as happens when it is
/// given in other coordinates. Throws InputError for more than most_regions names of regions, and for more
/// than max_mesh_parts parts.
std::vector<std::string> label_parts(Mesh& mesh, std::span<const PartRegion> regions,
                                     std::span<const glm::dvec3> places = {});

/// The mesh with the parts that its file labels, in ascending order of the labels, named as in the file or
/// else "part LABEL". Named labels of no triangle are parts too. A file without labels, or with a single one
/// that has no name, gives the one part "body". Throws InputError for more than max_mesh_parts parts.
Mesh mesh_with_labelled_parts(RawMesh raw);

} // namespace overt
