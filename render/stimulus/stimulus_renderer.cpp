#include "render/stimulus/stimulus_renderer.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/spectra/metal_table.h"
#include "render/bake/layered_surface.h"
#include "render/bake/light_sources.h"
#include "render/bake/live_shares.h"
#include "stimulus_shaders.h"

namespace overt {

namespace {

Texture2D texture_of(const GlContext& context, const LightProbe& probe) {
    Texture2D texture(context, probe.radiance.size_px, PixelFormat::rgba32f);
    texture.upload(std::as_bytes(std::span(probe.radiance.pixels)));
    texture.set_linear_filter_wrapped();
    return texture;
}

} // namespace

StimulusRenderer::StimulusRenderer(const GlContext& context, const LightSettings& light, glm::ivec2 image_px)
    : context_(&context), light_(light), probe_(distant_probe(light)), image_px_(image_px),
      program_(context, "stimulus", embedded::stimulus_vert, embedded::stimulus_frag),
      sharp_(texture_of(context, probe_)), soft_(texture_of(context, irradiance_over_pi(probe_, {64, 32}))),
      samples_(context, image_px * samples_per_side, PixelFormat::rgba32f, true),
      resolve_(context, "resolve", embedded::encode_vert, embedded::resolve_frag), no_attributes_(context),
      image_(context, image_px, PixelFormat::rgba32f) {}

void StimulusRenderer::set_material(const MaterialSettings& material) {
    material_ = material;
    live_ = &model_of(material.kind).live;
    mirrored_ = texture_of(*context_, live_->mirrored(probe_, material));
    const bool coated = live_->shading == LiveApproximation::Shading::coated_metal;
    reflectance_ = material.kind == MaterialKind::glass ? glm::dvec3(0.0)
                   : row_of(material.kind).has_key("reflectance")
                       ? material.given_reflectance()
                       : linear_rec709_of(normal_reflectance(load_metal(material.metal),
                                                             coated ? material.coat_ior : 1.0));
    shares_.reset();
    if (live_->shading == LiveApproximation::Shading::metal ||
        live_->shading == LiveApproximation::Shading::plastic) {
        LiveShares shares = live_shares(material);
        shares.mirrored.insert(shares.mirrored.end(), shares.even.begin(), shares.even.end());
        shares_.emplace(*context_, glm::ivec2(LiveShares::rows, 2), PixelFormat::rgba32f);
        shares_->upload(std::as_bytes(std::span(shares.mirrored)));
    }
}

LinearImage StimulusRenderer::draw(const MeshBuffers& mesh, const SceneView& scene, const Pose& pose) {
    OVERT_EXPECTS(mirrored_.has_value() && scene.view.image_px == image_px_);
    const GladGLContext& gl = context_->gl();
    samples_.bind();
    draw_nearest_only(gl);
    const GLfloat nothing[4] = {0, 0, 0, 0}, far = 1.0f;
    gl.ClearBufferfv(GL_COLOR, 0, nothing);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);

    using Shading = LiveApproximation::Shading;
    const double half_height = 0.5 * scene.bounds.extent().z;
    TurntablePose about_centre{glm::dvec3(0.0), pose.object};
    program_.use();
    program_.set("clip_from_object", clip_from_centred_object(scene, pose.object));
    program_.set("world_from_object", glm::mat4(about_centre.world_from_object()));
    program_.set("camera_position", glm::vec3(scene.view.camera.position - scene.bounds.centre()));
    program_.set("mirrored", 0);
    program_.set("sharp", 1);
    program_.set("soft", 2);
    program_.set("reflectance", glm::vec3(reflectance_));
    program_.set("lobe_radius", live_->lobe_radius(material_));
    program_.set("exposure", static_cast<float>(light_.exposure));
    program_.set("light_turn", static_cast<float>(pose.light.value / 360.0));
    program_.set("is_diffuse", live_->shading == Shading::matt ? 1 : 0);
    program_.set("shares", 3);
    program_.set("is_coated", live_->shading == Shading::coated_metal ? 1 : 0);
    program_.set("glass_ior",
                 material_.kind == MaterialKind::glass ? static_cast<float>(material_.ior) : 1.0f);
    program_.set("coat_ior", static_cast<float>(material_.coat_ior));
    program_.set("coat_absorbance",
                 glm::vec3(glm::dvec3(material_.coat_absorbance[0], material_.coat_absorbance[1],
                                      material_.coat_absorbance[2])));
    // Bumps of the height asked for on a lattice of 1/25 of the figure's height.
    const double bumps_per_unit = 12.5 / half_height;
    program_.set("bump_scale", static_cast<float>(bumps_per_unit));
    program_.set("bump_slope", static_cast<float>(material_.coat_bump * half_height * bumps_per_unit));
    mirrored_->bind(0);
    sharp_.bind(1);
    soft_.bind(2);
    if (shares_)
        shares_->bind(3);
    // The projection turns the picture upside down, and with it the fronts. What a closed surface has behind
    // is never seen.
    if (mesh.is_closed()) {
        gl.Enable(GL_CULL_FACE);
        gl.CullFace(GL_BACK);
        gl.FrontFace(GL_CW);
    }
    mesh.draw();
    gl.Disable(GL_CULL_FACE);

    image_.bind();
    gl.Disable(GL_DEPTH_TEST);
    resolve_.use();
    resolve_.set("samples", 0);
    resolve_.set("per_side", samples_per_side);
    samples_.texture().bind(0);
    no_attributes_.bind();
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    LinearImage image(image_px_);
    image_.read(PixelFormat::rgba32f, std::as_writable_bytes(std::span(image.pixels)));
    return image;
}

} // namespace overt
