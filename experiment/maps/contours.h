/// Where in an image one surface can give way to another: the pixels that a contour of the mesh goes through.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/maps/sight_lines.h"
#include "experiment/scene/mesh.h"

namespace overt {

/// One flag per pixel, top row first; 0 or 1.
using PixelFlags = std::vector<std::uint8_t>;

/// A contour is an edge at which the surface turns away from the eye, has a border, or branches. What is
/// visible changes from one sheet of surface to another, or to nothing, only where a contour is seen, or
/// where the mesh passes through itself. So within a pixel that no contour touches, and that the mesh does
/// not pierce, a single sheet is seen, or none.
class Contours {
  public:
    /// `mesh` must outlive this.
    explicit Contours(const Mesh& mesh);

    /// Flags each pixel whose square a contour touches that is no farther away than the pixel's farthest
    /// visible depth: one for each pixel, top row first. All pixels if a part of the mesh lies beside or
    /// behind the camera.
    PixelFlags touched_pixels(const SightLines& lines, glm::ivec2 size_px,
                              const std::vector<float>& farthest_visible) const;

  private:
    /// An edge and the corners opposite it in the two triangles that share it.
    struct Edge {
        std::uint32_t from, to, left, right;
    };
    const Mesh* mesh_;
    std::vector<Edge> folds_;   ///< between two triangles
    std::vector<Edge> borders_; ///< of one triangle, or of more than two; only from and to count
};

} // namespace overt
