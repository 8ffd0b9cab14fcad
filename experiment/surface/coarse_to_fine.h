/// Values of a coarse surface on the fine one.
#pragma once

#include <span>
#include <vector>

#include "experiment/surface/coarse_surface.h"

namespace overt {

/// Each node of the fine surface lies near a triangle of the coarse one: of those around the vertex that is
/// nearest along the surface, the one with the closest point. Its value is that between the triangle's
/// corners there, linearly, so that a map leaps over no gap and a linear one stays linear on a plane.
class CoarseToFine {
  public:
    /// Both must live as long as this only while it is made.
    CoarseToFine(const CoarseSurface& coarse, const SurfaceGeometry& fine);

    /// By vertex of the fine mesh, from values by vertex of the coarse one.
    std::vector<float> at_vertices(std::span<const float> of_coarse) const;

    /// By vertex of the fine mesh: the nearest vertex of the coarse one.
    const std::vector<std::uint32_t>& nearest() const { return nearest_; }

  private:
    struct Place {
        glm::uvec3 corners{0};
        glm::vec3 shares{1.0f, 0.0f, 0.0f};
    };
    std::vector<Place> places_; ///< by vertex of the fine mesh
    std::vector<std::uint32_t> nearest_;
};

/// The barycentric coordinates, none below 0, of the point of a triangle that is closest to another one.
/// A triangle without area gives a point of one of its sides.
glm::dvec3 closest_in_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c);

} // namespace overt
