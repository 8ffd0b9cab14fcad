/// The surface as the coordinate-encoded maps hold it: a cloud of points, or triangles between the pixels.
///
/// After section 3.2 of Sidorov, Harvey, Smithson and Hardeberg 2019, who show that a map is a reconstruction
/// of what is visible of the object.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/maps/coordinate_maps.h"
#include "experiment/maps/surface_point.h"

namespace overt {

/// Points in object coordinates, and the triangles between them if it is a surface.
struct Reconstruction {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;    ///< of unit length, towards the eye that saw the point
    std::vector<PartIndex> parts;      ///< one per point
    std::vector<std::uint16_t> views;  ///< in how many of the poses the point was seen
    std::vector<glm::uvec3> triangles; ///< counter-clockwise seen from outside; none in a cloud
};

/// The triangles between the pixel centres of one map. Two pixels that are neighbours in a row or column are
/// joined where SurfaceLookup::goes_on says that the surface goes on from one to the other; a triangle stands
/// where at least two sides of a square of four pixels are joined at a corner. So nothing spans a silhouette
/// or an edge where one part hides another. Points that belong to no triangle are left out.
Reconstruction reconstruct_surface(const SurfaceLookup& lookup, PoseIndex pose, glm::ivec2 size_px);

/// The pixel centres of several maps as one cloud. Where poses see the same place it is kept once: of all
/// points in a cube of `spacing` the first. `spacing` 0: the median distance of neighbouring pixels in the
/// first pose. `progress` is told after each pose; may be empty.
Reconstruction reconstruct_cloud(const SurfaceLookup& lookup, std::span<const PoseIndex> poses,
                                 glm::ivec2 size_px, double spacing = 0.0,
                                 const std::function<void(int done, int all)>& progress = {});

/// How much of a mesh is never seen.
struct SeenArea {
    double area = 0.0; ///< of the whole mesh, in the square of its unit
    double never_seen = 0.0;
    double share_never_seen() const { return area > 0.0 ? never_seen / area : 0.0; }
};

/// A triangle counts as seen, with all of its area, if any pose shows it at a pixel centre, or if nothing
/// hides the middle of the triangle from the eye. So the answer does not hang on the resolution; it is wrong
/// by no more than the triangles of which only a part is hidden. On all processors.
SeenArea seen_area(const CoordinateMaps& maps);

} // namespace overt
