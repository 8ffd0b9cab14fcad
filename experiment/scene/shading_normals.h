/// The normals that a surface is lit by.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

/// Normals of a triangle's corners.
using CornerNormals = std::array<glm::vec3, 3>;

/// For each corner of each triangle the area-weighted mean normal of the triangles around the vertex that are
/// turned against this one by no more than `crease_deg`: what is round looks round, and an edge stays an
/// edge. 0: the triangle's own normal; 180: of all around.
std::vector<CornerNormals> corner_normals(const Mesh& mesh, double crease_deg);

/// The crease of the surfaces that frames show.
inline constexpr double lit_crease_deg = 50.0;

} // namespace overt
