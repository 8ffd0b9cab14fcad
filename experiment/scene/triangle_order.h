/// The order in which triangles are drawn fastest.
#pragma once

#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/scene/surface_appearance.h"

namespace overt {

/// Reorders triangles so that neighbours follow one another (vertex cache) with outer layers first
/// (overdraw), and vertices in the order of first use. The same surface; triangle numbers change, so this
/// comes before maps are drawn. Deterministic. `from`, if it is given, gets where the corners of each
/// triangle come from.
void order_for_drawing(Mesh& mesh, std::vector<CornersFrom>* from = nullptr);

} // namespace overt
