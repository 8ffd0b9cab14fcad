/// What films, brushed metal, glass and media that scatter are held against, as layered surfaces are by
/// surface_laws.h.
#pragma once

#include "render/bake/surface_laws.h"

namespace overt {

/// All of them; a second or so.
std::vector<SurfaceLaw> further_laws();

} // namespace overt
