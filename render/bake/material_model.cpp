#include "render/bake/material_model.h"

#include <utility>

#include "render/bake/bake_scene.h"
#include "render/bake/layered_surface.h"

namespace overt {

const MaterialModel& model_of(MaterialKind kind) {
    using Model = const MaterialModel& (*)();
    constexpr auto models = []<std::size_t... i>(std::index_sequence<i...>) {
        return std::array<Model, sizeof...(i)>{&material_model<material_kinds[i].kind>...};
    }
    (std::make_index_sequence<material_kinds.size()>());
    return models[static_cast<std::size_t>(kind)]();
}

// material_rough_conductor.cpp
const MaterialModel& layered_metal();
const MaterialModel& brushed_metal();

const MaterialModel& model_of(const MaterialSettings& material) {
    if (material.is_own())
        return material_model<MaterialKind::own>();
    if (material.kind == MaterialKind::rough_conductor && material.anisotropy > 0.0)
        return brushed_metal();
    return material.kind == MaterialKind::rough_conductor &&
                   (material.multiple_scattering || material.clear_coat > 0.0)
               ? layered_metal()
               : model_of(material.kind);
}

MaterialModel layered_model() {
    return {.scatter = [](const BakeScene& scene, const SurfaceEvent& event, SampleSequence& sequence,
                          Bins& carried) { return scene.layers().scatter(event, sequence, carried); },
            .density = [](const BakeScene& scene, const SurfaceEvent& event,
                          glm::vec3 onward) { return scene.layers().density(event, onward); },
            .take = [](const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward,
                       Bins& carried) { scene.layers().take(event, onward, carried); },
            .layers = nullptr,
            .scatters = true,
            .path_cost = 2.0,
            .live = {}};
}

} // namespace overt
