/// Shapes that nobody has seen before and no word names, to be learned: a trunk with three limbs.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/scene/mesh.h"

namespace overt {

/// How many there are: "shape-01", "shape-02", …
inline constexpr int novel_shape_count = 24;

/// Their names, in order.
std::span<const std::string> novel_shape_names();

/// The number of a shape by its name, from 1; nothing for other names.
std::optional<int> novel_shape_number(std::string_view name);

/// The mesh of a shape in mm: standing on z = 0 with the middle of its bounding box above the origin, about
/// 200 mm wide. It is closed, edge-manifold, outward oriented and in one piece, and has the parts "trunk",
/// "crest" (the limb that points up), "left" and "right" (as seen from the front) in this order. Where limbs
/// are put on, how they bend and end, and the lumps of the trunk are drawn by the number. The same build
/// gives the same bits each time.
///
/// `number` is from 1 to novel_shape_count. `cell_mm`: size of the contouring grid's cells, 1 to 10.
/// `threads` is the most to use; 0 uses all processors. Throws InputError for another number or cell.
Mesh make_novel_shape(int number, double cell_mm = 2.5, int threads = 0);

} // namespace overt
