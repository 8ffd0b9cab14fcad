/// Translucent: light goes into the body, is scattered in it and leaves where it gets out.
#include <algorithm>

#include "render/bake/material_model.h"

namespace overt {

template <> const MaterialModel& material_model<MaterialKind::translucent>() {
    static const MaterialModel model{
        .scatter = nullptr,
        .density = nullptr,
        .take = nullptr,
        .layers = nullptr,
        .scatters = true,
        // As overt bench bake has it: marble 41, its surface rough 41, a hundredth as dense 9. `overt check`
        // measures each material of a protocol on each object.
        .path_cost = 40.0,
        // Live frames show a matt body of a thick one's colour under its border.
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
