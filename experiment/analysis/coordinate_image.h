/// A coordinate-encoded map as an image: for each pixel the object coordinates of the surface at its centre.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "experiment/analysis/sight_lines.h"
#include "experiment/analysis/surface_point.h"
#include "experiment/analysis/triangle_map.h"

namespace overt {

struct CoordinateImage {
    glm::ivec2 size_px{0};
    /// Top row first: x, y, z in object coordinates and the mesh's unit, and the coverage, which is 1 on the
    /// object and 0 off it, where all four are 0.
    std::vector<glm::vec4> pixels;

    CoordinateImage() = default;
    explicit CoordinateImage(glm::ivec2 size)
        : size_px(size),
          pixels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), glm::vec4(0.0f)) {}

    glm::vec4& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x) +
                      static_cast<std::size_t>(x)];
    }
    const glm::vec4& at(int x, int y) const { return const_cast<CoordinateImage*>(this)->at(x, y); }

    bool covers(int x, int y) const {
        return x >= 0 && y >= 0 && x < size_px.x && y < size_px.y && at(x, y).w != 0.0f;
    }
    std::size_t covered_pixels() const;
};

/// The coordinates that a map of triangles stands for: where each pixel centre's line of sight meets the
/// surface, found in double precision and rounded to float once. On all processors.
///
/// OpenGL moves corners to a grid of 1/256 of a pixel, so the triangle that it shows may miss the centre
/// barely. What counts is what the line of sight meets among the surfaces shown in the 3 x 3 pixels around:
/// at the outline that settles the coverage, too. A pixel amidst the object of which the line meets none (a
/// crack between triangles) gets the nearest place of the triangle shown.
///
/// `lookup` and `map` answer for `pose`; `sight` are its lines of sight, `mesh` the one drawn.
CoordinateImage coordinate_image(const SurfaceLookup& lookup, PoseIndex pose, const TriangleMap& map,
                                 const Mesh& mesh, const SightLines& sight);

} // namespace overt
