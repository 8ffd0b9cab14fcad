/// A coordinate-encoded map as an image: for each pixel the object coordinates of the surface at its centre.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "experiment/maps/surface_point.h"

namespace overt {

struct CoordinateImage {
    glm::ivec2 size_px{0};
    /// Top row first: x, y, z in object coordinates and the mesh's unit, and the coverage, which is 1 on the
    /// object and 0 off it, where all four are 0.
    std::vector<glm::vec4> pixels;
    /// The part of the figure that each pixel shows; empty if that is not known.
    std::vector<PartIndex> parts;

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

/// What a lookup shows at the pixel centres in a pose, rounded to float once. On all processors.
///
/// With the maps of a mesh these are the meetings of the pixel centres' lines of sight with the triangles, in
/// double: where OpenGL, which moves corners to a grid of 1/256 of a pixel, drew a triangle that misses the
/// centre barely, what counts is the surface that the line meets, and at the outline whether it meets any.
CoordinateImage coordinate_image(const SurfaceLookup& lookup, PoseIndex pose, glm::ivec2 size_px);

} // namespace overt
