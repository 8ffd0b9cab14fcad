/// Polished metal: a mirror.
#include "render/bake/bake_scene.h"
#include "render/bake/material_model.h"

namespace overt {

namespace {

glm::vec3 scatter(const BakeScene& scene, const SurfaceEvent& event, SampleSequence&, Bins& carried) {
    const float cosine = glm::dot(event.to_eye, event.normal);
    scene.metal().multiply_into(carried, cosine);
    return glm::normalize(2.0f * cosine * event.normal - event.to_eye);
}

LightProbe mirrored(const LightProbe& probe, const MaterialSettings&) { return probe; }

} // namespace

template <> const MaterialModel& material_model<MaterialKind::smooth_conductor>() {
    static constexpr MaterialModel model{
        .scatter = scatter,
        .density = nullptr,
        .take = nullptr,
        .layers = nullptr,
        .scatters = false,
        .path_cost = 1.0,
        .live = {LiveApproximation::Shading::metal, mirrored, [](const MaterialSettings&) { return 0.0f; }}};
    return model;
}

} // namespace overt
