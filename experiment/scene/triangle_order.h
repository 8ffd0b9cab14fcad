/// The order in which triangles are drawn fastest.
#pragma once

#include "experiment/scene/mesh.h"

namespace overt {

/// Reorders triangles so that neighbours follow one another (vertex cache) with outer layers first
/// (overdraw), and vertices in the order of first use. The same surface; triangle numbers change, so this
/// comes before maps are drawn. Deterministic.
void order_for_drawing(Mesh& mesh);

} // namespace overt
