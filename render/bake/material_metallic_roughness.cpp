/// Metal and plastic by share, as other programs have it, with a clear coat or without.
#include <algorithm>

#include "render/bake/bake_scene.h"
#include "render/bake/layered_surface.h"
#include "render/bake/material_model.h"

namespace overt {

template <> const MaterialModel& material_model<MaterialKind::metallic_roughness>() {
    static const MaterialModel model = [] {
        MaterialModel both = layered_model();
        both.layers = [](const MaterialSettings& material, const Bins& reflectance, const ConductorTable&) {
            return metallic_roughness_surface(material, reflectance);
        };
        both.live = material_model<MaterialKind::plastic>().live;
        both.path_cost = 2.4;
        return both;
    }();
    return model;
}

} // namespace overt
