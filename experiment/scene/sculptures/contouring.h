/// From a signed distance to a closed triangle mesh.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/scene/sculptures/signed_distance.h"

namespace overt {

/// Where the mesh is to be finer than elsewhere: inside `ball` the cells have `cell_share` of the full size,
/// outside they grow to the full size within about the ball's radius.
struct Fovea {
    Ball ball;
    double cell_share = 1.0; ///< above 0, at most 1
};

/// What to contour, and how finely.
struct ContourRequest {
    std::function<double(const glm::dvec3&)> distance; ///< mm; gradient no longer than about 1.3; thread-safe
    Bounds box_mm; ///< holds the whole surface, a cell away from the faces
    double cell_mm = 2.0;
    Fovea fovea;
    int threads = 0; ///< at most so many; 0: as many as the machine has processors
};

/// A closed surface without parts.
struct ClosedSurface {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles; ///< counter-clockwise seen from outside
};

/// The largest connected piece of the surface where the distance is 0, as triangles with their vertices on
/// it.
///
/// The method is surface nets [Gibson 1998] on a grid that is stretched about the fovea, with one vertex for
/// each sheet of the surface in a cell [Nielson 2004], so that every edge has exactly two triangles. Vertices
/// are then drawn along the surface towards the middle of their neighbours, for even triangles, and brought
/// back onto it by Newton steps. Pieces that the grid cuts off and hollows within the solid are left out.
///
/// The result is the same to the last bit whatever the number of threads. Throws InputError if nothing of the
/// surface is met by the grid.
ClosedSurface contour(const ContourRequest& request);

} // namespace overt
