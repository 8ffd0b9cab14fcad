/// How an object's file says that its surface looks, on the graphics card: colours and pictures of colours at
/// each place, what is metal too; roughness in the mean over each of the file's materials.
#pragma once

#include <optional>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/scene/surface_appearance.h"
#include "render/stimulus/mesh_buffers.h"

namespace overt {

/// Attributes 0 to 2 as of MeshBuffers, 3 the place on the picture, 4 the colour of the corner, linear, 5 the
/// place on the picture of metal. The
/// triangles lie in the order of the file's materials, so that gl_PrimitiveID tells nothing.
class PaintedSurface {
  public:
    /// `mesh` has its openness. `material`: of kind own or with base = own. Throws GraphicsError.
    PaintedSurface(const GlContext& context, const Mesh& mesh, const MeshBuffers& buffers,
                   const SurfaceAppearance& appearance, const MaterialSettings& material);

    /// The triangles of one of the file's materials.
    struct Piece {
        MaterialSettings material; ///< what it is in the mean, its colour too
        GLint first = 0;
        GLsizei count = 0;
        std::optional<Texture2D> picture; ///< nothing: its corners' colours are all
        std::optional<Texture2D> metal;   ///< blue: what is metal; nothing: the material's mean
        float metallic = 1.0f;            ///< factor on it
    };
    const std::vector<Piece>& pieces() const { return pieces_; }
    void draw(const Piece& piece) const;

  private:
    const GlContext* context_;
    VertexArray array_;
    std::vector<Buffer> buffers_;
    std::vector<Piece> pieces_;
};

} // namespace overt
