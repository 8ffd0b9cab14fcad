/// Following a surface from triangle to triangle to where a line of sight passes through it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

#include "experiment/base/large_pages.h"
#include "experiment/scene/mesh.h"

namespace overt {

constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// All that a walk needs to know of a triangle, in one cache line.
struct alignas(64) WalkTriangle {
    std::array<glm::vec3, 3> corners;
    /// The triangle across the edge opposite each corner; no_triangle where the mesh has a border there, or
    /// where more than two triangles meet.
    std::array<std::uint32_t, 3> neighbours{no_triangle, no_triangle, no_triangle};
    PartIndex part = 0;
};

/// Where a line of sight origin + depth * direction passes through a triangle.
struct Meeting {
    std::uint32_t triangle = 0;
    glm::dvec3 barycentric{0.0}; ///< weights of the corners, sum 1, none negative
    double depth = 0.0;
};

/// The triangles of a mesh with their neighbours. Takes 64 bytes for each.
class SurfaceWalk {
  public:
    explicit SurfaceWalk(const Mesh& mesh);

    const WalkTriangle& triangle(std::uint32_t index) const { return triangles_[index]; }
    std::size_t size() const { return triangles_.size(); }

    /// Goes from triangle to triangle, always across the edge that the line passes farthest outside, until it
    /// passes inside, and writes that into `meeting`. False if that leads over a border, over an edge behind
    /// which the surface turns its other side to the eye, or farther than a few pixels should take; and if
    /// the eye has the surface behind it.
    bool meet(std::uint32_t start, const glm::dvec3& origin, const glm::dvec3& direction,
              Meeting& meeting) const;

  private:
    LargePageVector<WalkTriangle> triangles_;
};

} // namespace overt
