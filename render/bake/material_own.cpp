/// What the object's file says of each place: its colours, and what is metal and how rough it is.
#include <algorithm>

#include "render/bake/bake_scene.h"
#include "render/bake/material_model.h"
#include "render/bake/own_surface.h"

namespace overt {

namespace {

MaterialModel model_of_own() {
    MaterialModel own{.scatter = [](const BakeScene& scene, const SurfaceEvent& event,
                                    SampleSequence& sequence,
                                    Bins& carried) { return scene.own()->scatter(event, sequence, carried); },
                      .density = [](const BakeScene& scene, const SurfaceEvent& event,
                                    glm::vec3 onward) { return scene.own()->density(event, onward); },
                      .take = [](const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward,
                                 Bins& carried) { scene.own()->take(event, onward, carried); },
                      .layers = nullptr,
                      .scatters = true,
                      .path_cost = 2.2, // overt bench bake, with three pictures
                      .live = material_model<MaterialKind::metallic_roughness>().live};
    return own;
}

} // namespace

template <> const MaterialModel& material_model<MaterialKind::own>() {
    static const MaterialModel model = model_of_own();
    return model;
}

} // namespace overt
