/// Bumps that are only in the light: the normals that a picture of the object's file gives each place.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/scene/shading_normals.h"
#include "experiment/scene/surface_appearance.h"
#include "render/bake/surface_tree.h"

namespace overt {

/// For each corner of each triangle the unit tangent, along which u of its normals' picture grows as it lies
/// there, and in w the side of the bitangent w cross(normal, tangent), along which v falls: 1, or -1 where
/// the picture lies mirrored. Zero for triangles without a place on such a picture.
using CornerTangents = std::array<glm::vec4, 3>;

/// Tangents on given normals of the corners: the means over the triangles around a vertex that have the same
/// place of the picture and the same normal there, weighed by their angles (as MikkTSpace, the convention of
/// glTF 2.0, has them; of the places as the picture lies, by KHR_texture_transform).
std::vector<CornerTangents> corner_tangents(const SurfaceAppearance& appearance, const Mesh& mesh,
                                            std::span<const CornerNormals> normals);

/// Made once for a stimulus and asked from any number of threads.
class Bumps {
  public:
    /// `normals`: of the mesh's corners, which may go afterwards, as may the mesh.
    Bumps(std::shared_ptr<const SurfaceAppearance> appearance, const Mesh& mesh,
          std::span<const CornerNormals> normals);

    /// In place of the shading normal at a hit, on the front; of unit length. The very same where the picture
    /// is flat.
    glm::vec3 normal_at(const SurfaceHit& hit) const;

  private:
    std::shared_ptr<const SurfaceAppearance> appearance_;
    std::vector<CornerTangents> tangents_;
};

} // namespace overt
