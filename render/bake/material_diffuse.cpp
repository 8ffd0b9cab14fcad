/// A matt surface: equally bright from everywhere (Lambert).
#include <algorithm>
#include <numbers>

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

float density(const BakeScene&, const SurfaceEvent& event, glm::vec3 onward) {
    return std::max(0.0f, glm::dot(event.normal, onward)) / std::numbers::pi_v<float>;
}

void take(const BakeScene& scene, const SurfaceEvent&, glm::vec3, Bins& carried) {
    multiply(carried, scene.reflectance());
}

LightProbe mirrored(const LightProbe& probe, const MaterialSettings&) {
    return irradiance_over_pi(probe, {64, 32});
}

} // namespace

template <> const MaterialModel& material_model<MaterialKind::diffuse>() {
    static constexpr MaterialModel model{
        .scatter = scatter,
        .density = density,
        .take = take,
        .layers = nullptr,
        .scatters = true,
        .path_cost = 1.6,
        .live = {LiveApproximation::Shading::matt, mirrored, [](const MaterialSettings&) { return 1.0f; }}};
    return model;
}

} // namespace overt
