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

/// Brushed: rougher across its scratches than along them. glTF's extension for anisotropy mixes the widths
/// so, and names the direction in which highlights are long; scratches run across that.
struct Brushed {
    NormalFrame frame;
    GgxWidths alpha;

    Brushed(const BakeScene& scene, const SurfaceEvent& event) : frame(event.normal, scratch(scene, event)) {
        const MaterialSettings& material = scene.material();
        const double square = material.anisotropy * material.anisotropy;
        alpha.along = static_cast<float>(material.given_roughness());
        alpha.across = static_cast<float>(material.given_roughness() * (1.0 - square) + square);
    }

    /// In coordinates of the object, whose vertical is z.
    static glm::vec3 scratch(const BakeScene& scene, const SurfaceEvent& event) {
        const glm::vec3 vertical(0.0f, 0.0f, 1.0f);
        return scene.material().brushed == BrushedAlong::upward ? vertical
                                                                : glm::cross(vertical, event.normal);
    }
};

glm::vec3 scatter_brushed(const BakeScene& scene, const SurfaceEvent& event, SampleSequence& sequence,
                          Bins& carried) {
    const Brushed brushed(scene, event);
    const glm::vec3 micro = brushed.frame.to_world(
        ggx_visible_normal(brushed.frame.to_local(event.to_eye), brushed.alpha, sequence.next_two()));
    const float cosine = glm::dot(event.to_eye, micro);
    const glm::vec3 out = 2.0f * cosine * micro - event.to_eye;
    const float visible = ggx_visible_share(brushed.frame.to_local(out), brushed.alpha);
    if (visible <= 0.0f)
        return glm::vec3(0.0f);
    scene.metal().multiply_into(carried, cosine);
    scale(carried, visible);
    return out;
}

float density_of_brushed(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward) {
    const Brushed brushed(scene, event);
    const glm::vec3 to_eye = brushed.frame.to_local(event.to_eye), out = brushed.frame.to_local(onward);
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return 0.0f;
    return ggx_visible_share(to_eye, brushed.alpha) *
           ggx_density(glm::normalize(to_eye + out), brushed.alpha) / (4.0f * to_eye.z);
}

void take_of_brushed(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward, Bins& carried) {
    const Brushed brushed(scene, event);
    const glm::vec3 micro = glm::normalize(event.to_eye + onward);
    scene.metal().multiply_into(carried, glm::dot(event.to_eye, micro));
    scale(carried, ggx_visible_share(brushed.frame.to_local(onward), brushed.alpha));
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

const MaterialModel& brushed_metal() {
    static const MaterialModel model = [] {
        MaterialModel brushed = material_model<MaterialKind::rough_conductor>();
        brushed.scatter = scatter_brushed;
        brushed.density = density_of_brushed;
        brushed.take = take_of_brushed;
        return brushed;
    }();
    return model;
}

const MaterialModel& layered_metal() {
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
