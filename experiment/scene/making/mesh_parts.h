/// Which part of the figure each triangle belongs to: by regions of space, or by labels of the mesh file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

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

/// Name of the part that results tell from the rest.
inline constexpr std::string_view head_part = "head";

/// Which parts of an object belong to its head: the part "head", and those that lie in it ("head/eyes").
class HeadParts {
  public:
    HeadParts() = default;
    /// One part.
    HeadParts(PartIndex part) : parts_(std::size_t{part} + 1, false) { parts_.back() = true; }
    /// By the names of all parts, in their order.
    explicit HeadParts(std::span<const std::string> part_names);

    /// Whether there is any.
    bool has_value() const;
    explicit operator bool() const { return has_value(); }
    bool has(std::optional<PartIndex> part) const { return part && *part < parts_.size() && parts_[*part]; }
    void reset() { parts_.clear(); }

  private:
    std::vector<bool> parts_; ///< by PartIndex
};

/// Whether a part of that name belongs to the head.
bool is_of_head(std::string_view part_name);

/// Adds the regions to the parts that the mesh has: the first region that contains the centroid of a triangle
/// has it. Regions with the same name are one part. A part that lies in a region as a whole stays a part of
/// its own, named as lying in it ("head/eyes"); of one that reaches beyond it the region takes what it
/// contains. Where the mesh has but one part, the region takes that, too.
///
/// `places` are those of the vertices in the coordinates in which the regions are given; empty: the mesh's
/// own. A region noted in a file's coordinates is applied before the mesh is turned and scaled, which
/// import_mesh does. Gives a sentence for each part that was cut.
///
/// Throws InputError if a region has no name, neither spheres nor half-spaces, a radius that is not positive,
/// a normal of length 0 or a number that is not finite; if it contains no triangle, as happens when it is
/// given in other coordinates; and for more than max_mesh_parts parts.
std::vector<std::string> label_parts(Mesh& mesh, std::span<const PartRegion> regions,
                                     std::span<const glm::dvec3> places = {});

/// The mesh with the parts that its file labels, in ascending order of the labels, named as in the file or
/// else "part LABEL". Named labels of no triangle are parts too. A file without labels, or with a single one
/// that has no name, gives the one part "body". Throws InputError for more than max_mesh_parts parts.
Mesh mesh_with_labelled_parts(RawMesh raw);

} // namespace overt
