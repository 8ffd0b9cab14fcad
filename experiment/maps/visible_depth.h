/// How far away the surface is that a map shows.
#pragma once

#include <vector>

#include "experiment/maps/sight_lines.h"
#include "experiment/maps/surface_walk.h"
#include "experiment/maps/triangle_map.h"

namespace overt {

/// For each pixel, top row first, a depth beyond which nothing can be seen in it: that of the farthest centre
/// among the 3 x 3 pixels around, and once more as much behind it as these nine differ. Infinite where not
/// all nine show the object. Supposes that within a pixel the visible surface falls back no further than
/// that.
std::vector<float> farthest_visible_depths(const TriangleMap& map, const SightLines& lines,
                                           const SurfaceWalk& walk);

} // namespace overt
