/// The surfaces of a stimulus as a path meets them. Embree stays behind surface_tree.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/shading_normals.h"

namespace overt {

/// A surface to be traced, about a centre: coordinates are small, for they are floats.
struct TracedSurface {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<CornerNormals> normals;

    TracedSurface() = default;
    TracedSurface(const Mesh& mesh, glm::dvec3 centre, double crease_deg);
};

struct PathRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; ///< unit length
};

/// A path's meeting with a surface.
struct SurfaceHit {
    int surface = -1; ///< -1: none
    std::uint32_t triangle = 0;
    glm::vec2 place{0.0f}; ///< in the triangle: shares of its second and third corner
    float distance = 0.0f;
    glm::vec3 position{0.0f};
    glm::vec3 triangle_normal{0.0f}; ///< unit length, on the side of the triangle's front
    glm::vec3 shading_normal{0.0f};  ///< the same, from the corners' normals
};

/// Up to two surfaces. Cast from any number of threads at once; nothing allocates.
class SurfaceTree {
  public:
    /// The surfaces must outlive the tree and stay as they are. Built by one thread, so that it is the same
    /// each time. Throws GraphicsError if Embree refuses.
    explicit SurfaceTree(std::vector<const TracedSurface*> surfaces);
    ~SurfaceTree();
    SurfaceTree(SurfaceTree&&) noexcept;
    SurfaceTree& operator=(SurfaceTree&&) noexcept;

    /// The nearest meeting within `limit`. `coherent`: neighbouring calls have neighbouring rays.
    SurfaceHit first_hit(const PathRay& ray, float limit, bool coherent) const noexcept;
    /// Only whether and where: the distance, or a negative number.
    float first_distance(const PathRay& ray, bool coherent) const noexcept;
    /// How far `point` is from the nearest surface, or `most` if it is farther.
    float clearance(glm::vec3 point, float most) const noexcept;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

} // namespace overt
