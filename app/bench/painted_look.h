/// A look for meshes whose files say none: for what is measured of textured objects.
#pragma once

#include <memory>

#include "experiment/scene/surface_appearance.h"

namespace overt {

/// Three pictures, as a scan has them, laid through the mesh from front to back: colours, metal and
/// roughness, bumps; no neighbouring texels are alike.
std::shared_ptr<const SurfaceAppearance> painted_look(const Mesh& mesh);

} // namespace overt
