/// Where a mesh passes through itself, as far as a map shows it.
#pragma once

#include "experiment/maps/contours.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/maps/surface_walk.h"
#include "experiment/maps/triangle_map.h"

namespace overt {

/// Within pixels that no contour touches, walking along the surface from one pixel's centre to the next must
/// arrive at what the map shows there. Flags the pixels around each place where it does not: there the mesh
/// pierces itself, or the map has taken the wrong one of two surfaces. `flags` holds what contours touch, and
/// gets the new ones added.
void flag_discontinuities(const TriangleMap& map, const SightLines& lines, const SurfaceWalk& walk,
                          PixelFlags& flags);

} // namespace overt
