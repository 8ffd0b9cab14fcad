/// A matt surface: equally bright from everywhere (Lambert).
#include "render/bake/bake_scene.h"
#include "render/bake/material_model.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

glm::vec3 scatter(const BakeScene& scene, const SurfaceEvent& event, SampleSequence& sequence,
                  Bins& carried) {
    multiply(carried, scene.reflectance());
    return NormalFrame(event.normal).to_world(cosine_direction(sequence.next_two()));
}

LightProbe mirrored(const LightProbe& probe, const MaterialSettings&) {
    return irradiance_over_pi(probe, {64, 32});
}

} // namespace

template <> const MaterialModel& material_model<MaterialKind::diffuse>() {
    static constexpr MaterialModel model{
        .scatter = scatter,
        .scatters = true,
        .path_cost = 1.6,
        .live = {LiveApproximation::Shading::matt, mirrored, [](const MaterialSettings&) { return 1.0f; }}};
    return model;
}

} // namespace overt
