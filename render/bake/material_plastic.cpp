/// Plastic: a clear surface, polished or rough, over a matt body.
#include <algorithm>

#include "render/bake/bake_scene.h"
#include "render/bake/layered_surface.h"
#include "render/bake/material_model.h"

namespace overt {

template <> const MaterialModel& material_model<MaterialKind::plastic>() {
    static const MaterialModel model = [] {
        MaterialModel plastic = layered_model();
        plastic.layers = [](const MaterialSettings& material, const Bins& reflectance,
                            const ConductorTable&) { return plastic_surface(material, reflectance); };
        plastic.live = {
            LiveApproximation::Shading::plastic,
            [](const LightProbe& probe, const MaterialSettings& material) {
                return blurred_by_ggx(probe, std::max(material.alpha(), 1e-3), {512, 256});
            },
            [](const MaterialSettings& material) { return static_cast<float>(2.0 * material.alpha()); }};
        return plastic;
    }();
    return model;
}

} // namespace overt
