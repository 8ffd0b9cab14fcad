/// Glass: light is mirrored at its surface and goes through.
#include <algorithm>

#include "render/bake/material_model.h"

namespace overt {

template <> const MaterialModel& material_model<MaterialKind::glass>() {
    static const MaterialModel model{
        .scatter = nullptr,
        .density = nullptr,
        .take = nullptr,
        .layers = nullptr,
        .scatters = true,
        // overt bench bake: 3.6 polished, 4.1 with an Abbe number, 7.2 rough.
        .path_cost = 4.5,
        // Live frames show what its surface mirrors, and what a ball of it would let through.
        .live = {LiveApproximation::Shading::plastic,
                 [](const LightProbe& probe, const MaterialSettings& material) {
                     return material.roughness
                                ? blurred_by_ggx(probe, std::max(material.alpha(), 1e-3), {512, 256})
                                : probe;
                 },
                 [](const MaterialSettings& material) {
                     return material.roughness ? static_cast<float>(2.0 * material.alpha()) : 0.0f;
                 }}};
    return model;
}

} // namespace overt
