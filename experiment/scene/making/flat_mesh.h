/// A flat rectangle as a mesh, for pictures.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "experiment/scene/making/mesh_parts.h"
#include "experiment/scene/mesh.h"

namespace overt {

/// Cells along the longer side of a flat rectangle: maps of gaze are finer than any kernel of theirs.
inline constexpr int flat_cells = 128;

/// The rectangle from (0, 0, 0) to (size.x, 0, size.y), its front to -y, in triangles of about the same size.
/// The corners of the regions' boxes lie on lines of the grid, so that a box within the rectangle is one to
/// the rounding of a float; other regions are by the middles of triangles. Labels as label_parts. Throws
/// InputError as that does, and for a size that is not positive.
Mesh make_flat_mesh(glm::dvec2 size, std::span<const PartRegion> regions);

} // namespace overt
