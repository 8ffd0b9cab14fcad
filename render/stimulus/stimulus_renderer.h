/// Objects in metal under a light probe, drawn by OpenGL: an approximation for a first look and for quick
/// protocols. It knows no interreflection but one guessed bounce, and no spectra.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "render/bake/material_model.h"
#include "render/gl/shader_program.h"
#include "render/image/light_probe.h"
#include "render/image/linear_image.h"
#include "render/stimulus/mesh_buffers.h"
#include "render/stimulus/painted_surface.h"
#include "render/stimulus/scene_view.h"

namespace overt {

/// Changes whenever the same inputs would give other pixels: part of the key under which frames are kept.
constexpr int stimulus_renderer_version = 8;

/// One light, turned as each picture needs it.
class StimulusRenderer {
  public:
    /// Throws InputError for the light probe, GraphicsError for the context.
    StimulusRenderer(const GlContext& context, const LightSettings& light, glm::ivec2 image_px);

    /// Prepares the probe as this material mirrors it and reads its metal, for the draws that follow. Throws
    /// InputError for an unknown metal.
    void set_material(const MaterialSettings& material);
    /// The same for each material of an object's file, which draws then show in place of the mesh's own
    /// surface. `surface` must outlive them.
    void set_painted(const PaintedSurface& surface);

    /// Linear display RGB, alpha = share of each pixel that the object covers. 2 x 2 samples a pixel, box
    /// filter.
    LinearImage draw(const MeshBuffers& mesh, const SceneView& scene, const Pose& pose);

  private:
    static constexpr int samples_per_side = 2;
    const GlContext* context_;
    LightSettings light_;
    LightProbe probe_;
    glm::ivec2 image_px_;
    ShaderProgram program_;
    Texture2D sharp_;
    Texture2D soft_;
    /// A material, ready to be drawn.
    struct Prepared {
        MaterialSettings material;
        const LiveApproximation* live = nullptr;
        std::shared_ptr<Texture2D> mirrored; ///< several materials may have one
        std::optional<Texture2D> shares;     ///< LiveShares: see stimulus.frag
        glm::dvec3 reflectance{0.0};         ///< of a metal at normal incidence, or albedo
    };
    Prepared prepared(const MaterialSettings& material, const PaintedSurface::Piece* piece) const;
    void use(const Prepared& of, const SceneView& scene, const PaintedSurface::Piece* piece);

    std::vector<Prepared> prepared_;
    const PaintedSurface* painted_ = nullptr; ///< of which prepared_ are the pieces
    Framebuffer samples_;
    ShaderProgram resolve_;
    VertexArray no_attributes_;
    Framebuffer image_;
};

} // namespace overt
