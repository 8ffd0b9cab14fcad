/// Quadrilaterals between the inside and the outside nodes of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiment/scene/sculptures/stretched_grid.h"

namespace overt {

/// Closed surface of polygons: each edge belongs to exactly two polygons, in opposite directions.
struct PolygonNet {
    std::vector<glm::dvec3> positions;               ///< mm, near the surface
    std::vector<std::array<std::uint32_t, 4>> quads; ///< counter-clockwise seen from outside
    std::vector<glm::uvec3> triangles;               ///< the few polygons of more corners, cut up
};

/// The net that parts the grid's inside nodes from its outside nodes: one vertex for each sheet in a cell
/// (nodes inside that meet only across a face's diagonal belong to different sheets), one polygon for each
/// edge of the grid that the surface cuts. The grid's outermost nodes must be outside.
PolygonNet surface_net(const StretchedGrid& grid);

} // namespace overt
