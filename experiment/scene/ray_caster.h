/// Where a line of sight meets a mesh. Embree finds the candidates, double precision decides.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/viewing.h"

namespace overt {

/// A ray's meeting with a triangle.
struct RayHit {
    std::uint32_t triangle = 0;  ///< index into the mesh's triangles
    glm::dvec3 barycentric{0.0}; ///< weights of the triangle's corners, each >= 0, sum 1
    double distance = 0.0;       ///< from the ray's origin, in the mesh's unit
    glm::dvec3 position{0.0};    ///< in object coordinates
};

/// Casts rays at a mesh, from any number of threads at once; no query allocates.
///
/// What is guaranteed: the answer is that of testing every triangle in double precision. Embree's tree holds
/// floats, but its boxes are widened by more than all rounding of a ray to float can amount to, and each
/// triangle that it proposes is tested against the ray as it was given. Which side of an edge a ray passes on
/// comes out the same for both triangles at the edge, so a closed mesh has no gaps. Front and back faces both
/// count. Of meetings at the same distance the triangle with the lower index wins.
class RayCaster {
  public:
    /// `mesh` must outlive this and stay as it is. Throws GraphicsError if Embree refuses (out of memory).
    explicit RayCaster(const Mesh& mesh);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// The nearest meeting in front of the origin of a ray in object coordinates (see to_object), if any.
    std::optional<RayHit> first_hit(const Ray& object_ray) const noexcept;

    /// first_hit of each ray, on all processors. Both spans are equally long.
    void first_hits(std::span<const Ray> object_rays, std::span<std::optional<RayHit>> hits) const;

    /// Whether the mesh hides a point of its surface from an eye; both in object coordinates. What lies
    /// within 1e-9 of the distance before the point counts as the surface itself.
    bool is_hidden(glm::dvec3 surface_point, glm::dvec3 eye) const noexcept;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

} // namespace overt
