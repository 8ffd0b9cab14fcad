/// Parts of a mesh by colours that somebody painted on it.
#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// A colour that stands for a part, in codes of sRGB. Several may stand for one.
struct PartColour {
    glm::ivec3 code{0};
    std::string part;
};

/// "#rrggbb" as messages write it.
std::string colour_code_text(glm::ivec3 code);

/// Labels each triangle by the colour that most of it has: of its corners, or, where a picture lies on it, of
/// 16 places, each the texel there. `look` is of a file with the same triangles, and no bright colour may be
/// scaled in it. A colour is one of `colours` if no channel differs by more than two codes. A triangle with
/// none of them has the nearest, which a remark of the mesh tells, as it tells what share of the area is of
/// triangles with several colours, if it is more than a tenth, and which colour no triangle has. Replaces
/// labels and names that the mesh has. Throws InputError without the file's name if `look` has no colours, if
/// two parts have one colour, or if more than 5 % of the area has none of them, with the first such colour.
void label_by_colours(RawMesh& mesh, const SurfaceAppearance& look, std::span<const PartColour> colours);

} // namespace overt
