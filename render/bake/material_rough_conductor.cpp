/// Brushed metal: a crowd of small mirrors.
#include "render/bake/bake_scene.h"
#include "render/bake/layered_surface.h"
#include "render/bake/material_model.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

glm::vec3 scatter(const BakeScene& scene, const SurfaceEvent& event, SampleSequence& sequence,
                  Bins& carried) {
    const auto alpha = static_cast<float>(scene.material().given_roughness());
    const NormalFrame frame(event.normal);
    const glm::vec3 micro =
        frame.to_world(ggx_visible_normal(frame.to_local(event.to_eye), alpha, sequence.next_two()));
    const float cosine = glm::dot(event.to_eye, micro);
    const glm::vec3 out = 2.0f * cosine * micro - event.to_eye;
    const float visible = ggx_visible_share(frame.to_local(out), alpha);
    if (visible <= 0.0f)
        return glm::vec3(0.0f); // met another of the small mirrors: light of two of them is not followed
    scene.metal().multiply_into(carried, cosine);
    scale(carried, visible);
    return out;
}

/// Visible normals have the density G1 D (h . eye) / cos_eye, and to a mirrored direction belong 4 (h . eye)
/// times as many steradians as to its normal (Walter et al. 2007, eq. 14; Heitz 2018).
float density(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward) {
    const auto alpha = static_cast<float>(scene.material().given_roughness());
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye), out = frame.to_local(onward);
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return 0.0f;
    return ggx_visible_share(to_eye, alpha) * ggx_density(glm::normalize(to_eye + out), alpha) /
           (4.0f * to_eye.z);
}

void take(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward, Bins& carried) {
    const auto alpha = static_cast<float>(scene.material().given_roughness());
    const glm::vec3 micro = glm::normalize(event.to_eye + onward);
    scene.metal().multiply_into(carried, glm::dot(event.to_eye, micro));
    scale(carried, ggx_visible_share(NormalFrame(event.normal).to_local(onward), alpha));
}

LightProbe mirrored(const LightProbe& probe, const MaterialSettings& material) {
    return blurred_by_ggx(probe, material.given_roughness(), {256, 128});
}

float lobe_radius(const MaterialSettings& material) {
    return static_cast<float>(2.0 * material.given_roughness());
}

} // namespace

template <> const MaterialModel& material_model<MaterialKind::rough_conductor>() {
    static constexpr MaterialModel model{.scatter = scatter,
                                         .density = density,
                                         .take = take,
                                         .layers = nullptr,
                                         .scatters = true,
                                         .path_cost = 1.5,
                                         .live = {LiveApproximation::Shading::metal, mirrored, lobe_radius}};
    return model;
}

const MaterialModel& rough_metal_with_all_light() {
    static const MaterialModel model = [] {
        MaterialModel layered = layered_model();
        layered.layers = [](const MaterialSettings& material, const Bins&, const ConductorTable& metal) {
            return rough_metal_surface(material, metal);
        };
        layered.path_cost = 2.0;
        layered.live = material_model<MaterialKind::rough_conductor>().live;
        return layered;
    }();
    return model;
}

} // namespace overt
