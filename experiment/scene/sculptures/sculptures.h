/// The sculptures that come with the program, modelled by code of this project, under its licence.
#pragma once

#include <span>
#include <string_view>

#include "experiment/scene/mesh.h"

namespace overt {

struct SculptureDescription {
    std::string_view name;        ///< as written in protocols
    std::string_view title;       ///< as shown to people
    std::string_view description; ///< one sentence
};

/// All sculptures, in the order in which they are listed to people.
std::span<const SculptureDescription> shipped_sculptures();

/// Cells of the contouring grid, as a share of a sculpture's height (about 600 mm); heads get finer ones.
inline constexpr double default_cell_share = 1.0 / 240.0; ///< 100 000 to 300 000 triangles
inline constexpr double coarse_cell_share = 1.0 / 45.0;   ///< below 10 000 triangles: quick, features blurred

/// The sculpture's mesh in mm: standing on z = 0 with the middle of its bounding box above the origin, front
/// towards -y, about 600 mm high. The mesh is closed, edge-manifold, outward oriented and in one piece, and
/// has the parts "head", "body" and "plinth" in this order. The same build gives the same bits each time.
///
/// `cell_share` is from 1/1000 to 1/20. `threads` is the most to use; 0 uses all processors. Throws
/// InputError for a name that is not shipped, listing those that are, and for a cell_share out of range.
Mesh make_sculpture(std::string_view name, double cell_share = default_cell_share, int threads = 0);

} // namespace overt
