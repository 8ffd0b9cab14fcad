#include "render/stimulus/stimulus_renderer.h"

#include <algorithm>
#include <cmath>

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

/// What is mirrored, and below it what is even.
std::vector<glm::vec4> rows_of(LiveShares shares) {
    shares.mirrored.insert(shares.mirrored.end(), shares.even.begin(), shares.even.end());
    return std::move(shares.mirrored);
}

/// Shares rise with the colour nearly on a line, from black through the mean of the surface: those of black,
/// and what a colour adds for each share of it.
std::vector<glm::vec4> painted_rows(const MaterialSettings& material, const glm::dvec3& mean) {
    MaterialSettings black = material;
    black.reflectance = glm::dvec3(0.0);
    std::vector<glm::vec4> rows = rows_of(live_shares(black)), own = rows_of(live_shares(material));
    const glm::vec4 by(glm::max(glm::vec3(mean), glm::vec3(0.02f)), 1.0f);
    for (std::size_t i = 0; i < own.size(); ++i)
        own[i] = (own[i] - rows[i]) / by;
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
}

} // namespace

StimulusRenderer::StimulusRenderer(const GlContext& context, const LightSettings& light, glm::ivec2 image_px)
    : context_(&context), light_(light), probe_(distant_probe(light)), image_px_(image_px),
      program_(context, "stimulus", embedded::stimulus_vert, embedded::stimulus_frag),
      sharp_(texture_of(context, probe_)), soft_(texture_of(context, irradiance_over_pi(probe_, {64, 32}))),
      samples_(context, image_px * samples_per_side, PixelFormat::rgba32f, true),
      resolve_(context, "resolve", embedded::encode_vert, embedded::resolve_frag), no_attributes_(context),
      image_(context, image_px, PixelFormat::rgba32f) {}

StimulusRenderer::Prepared StimulusRenderer::prepared(const MaterialSettings& material,
                                                      const PaintedSurface::Piece* piece) const {
    Prepared made{material, &model_of(material.kind).live, nullptr, std::nullopt, glm::dvec3(0.0)};
    const bool coated = made.live->shading == LiveApproximation::Shading::coated_metal;
    const bool lets_through =
        material.kind == MaterialKind::glass || material.kind == MaterialKind::translucent;
    made.reflectance = lets_through ? glm::dvec3(0.0)
                       : row_of(material.kind).has_key("reflectance")
                           ? material.given_reflectance()
                           : linear_rec709_of(normal_reflectance(load_metal(material.metal),
                                                                 coated ? material.coat_ior : 1.0));
    for (const Prepared& other : prepared_)
        if (other.material.kind == material.kind && other.material.roughness == material.roughness)
            made.mirrored = other.mirrored;
    if (!made.mirrored)
        made.mirrored =
            std::make_shared<Texture2D>(texture_of(*context_, made.live->mirrored(probe_, material)));
    if (made.live->shading != LiveApproximation::Shading::metal &&
        made.live->shading != LiveApproximation::Shading::plastic)
        return made;
    std::vector<glm::vec4> rows;
    const auto add_painted = [&](std::optional<double> metallic) {
        MaterialSettings of = material;
        of.metallic = metallic ? metallic : of.metallic;
        const std::vector<glm::vec4> painted = painted_rows(of, made.reflectance);
        rows.insert(rows.end(), painted.begin(), painted.end());
    };
    if (!piece) {
        rows = rows_of(live_shares(material));
    } else if (!piece->metal) {
        add_painted(std::nullopt);
    } else {
        add_painted(0.0);
        add_painted(1.0);
    }
    made.shares.emplace(*context_,
                        glm::ivec2(LiveShares::rows, static_cast<int>(rows.size()) / LiveShares::rows),
                        PixelFormat::rgba32f);
    made.shares->upload(std::as_bytes(std::span(rows)));
    return made;
}

void StimulusRenderer::set_material(const MaterialSettings& material) {
    prepared_.clear();
    painted_ = nullptr;
    prepared_.push_back(prepared(material, nullptr));
}

void StimulusRenderer::set_painted(const PaintedSurface& surface) {
    prepared_.clear();
    painted_ = &surface;
    // Materials of nearly one roughness have one picture of the probe.
    constexpr double roughness_step = 1.0 / 32.0;
    for (const PaintedSurface::Piece& piece : surface.pieces()) {
        MaterialSettings material = piece.material;
        if (material.roughness)
            material.roughness =
                std::max(0.001, roughness_step * std::round(*material.roughness / roughness_step));
        prepared_.push_back(prepared(material, &piece));
    }
}

void StimulusRenderer::use(const Prepared& of, const SceneView& scene, const PaintedSurface::Piece* piece) {
    using Shading = LiveApproximation::Shading;
    const MaterialSettings& material = of.material;
    const double half_height = 0.5 * scene.bounds.extent().z;
    program_.set("reflectance", glm::vec3(of.reflectance));
    program_.set("lobe_radius", of.live->lobe_radius(material));
    program_.set("is_diffuse", of.live->shading == Shading::matt ? 1 : 0);
    program_.set("is_coated", of.live->shading == Shading::coated_metal ? 1 : 0);
    program_.set("glass_ior", material.kind == MaterialKind::glass ? static_cast<float>(material.ior) : 1.0f);
    program_.set("coat_ior", static_cast<float>(material.coat_ior));
    program_.set("coat_absorbance",
                 glm::vec3(glm::dvec3(material.coat_absorbance[0], material.coat_absorbance[1],
                                      material.coat_absorbance[2])));
    // Bumps of the height asked for on a lattice of 1/25 of the figure's height.
    const double bumps_per_unit = 12.5 / half_height;
    program_.set("bump_scale", static_cast<float>(bumps_per_unit));
    program_.set("bump_slope", static_cast<float>(material.coat_bump * half_height * bumps_per_unit));
    program_.set("is_painted", piece ? 1 : 0);
    program_.set("has_picture", piece && piece->picture ? 1 : 0);
    program_.set("has_metal", piece && piece->metal ? 1 : 0);
    program_.set("metallic", piece ? piece->metallic : 1.0f);
    of.mirrored->bind(0);
    if (of.shares)
        of.shares->bind(3);
    if (piece && piece->picture)
        piece->picture->bind(4);
    if (piece && piece->metal)
        piece->metal->bind(5);
}

LinearImage StimulusRenderer::draw(const MeshBuffers& mesh, const SceneView& scene, const Pose& pose) {
    OVERT_EXPECTS(!prepared_.empty() && scene.view.image_px == image_px_);
    const GladGLContext& gl = context_->gl();
    samples_.bind();
    draw_nearest_only(gl);
    const GLfloat nothing[4] = {0, 0, 0, 0}, far = 1.0f;
    gl.ClearBufferfv(GL_COLOR, 0, nothing);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);

    TurntablePose about_centre{glm::dvec3(0.0), pose.object};
    program_.use();
    program_.set("clip_from_object", clip_from_centred_object(scene, pose.object));
    program_.set("world_from_object", glm::mat4(about_centre.world_from_object()));
    program_.set("camera_position", glm::vec3(scene.view.camera.eye() - scene.bounds.centre()));
    program_.set("mirrored", 0);
    program_.set("sharp", 1);
    program_.set("soft", 2);
    program_.set("shares", 3);
    program_.set("picture", 4);
    program_.set("metal", 5);
    program_.set("exposure", static_cast<float>(light_.exposure));
    program_.set("light_turn", static_cast<float>(pose.light.value / 360.0));
    sharp_.bind(1);
    soft_.bind(2);
    // The projection turns the picture upside down, and with it the fronts. What a closed surface has behind
    // is never seen.
    if (mesh.is_closed()) {
        gl.Enable(GL_CULL_FACE);
        gl.CullFace(GL_BACK);
        gl.FrontFace(GL_CW);
    }
    for (std::size_t i = 0; i < prepared_.size(); ++i) {
        const PaintedSurface::Piece* const piece = painted_ ? &painted_->pieces()[i] : nullptr;
        use(prepared_[i], scene, piece);
        if (piece)
            painted_->draw(*piece);
        else
            mesh.draw();
    }
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
