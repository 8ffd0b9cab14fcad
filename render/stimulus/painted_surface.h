/// How an object's file says that its surface looks, on the graphics card: colours and pictures of colours at
/// each place, metal and roughness in the mean over each of the file's materials.
#pragma once

#include <optional>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/scene/surface_appearance.h"
#include "render/stimulus/mesh_buffers.h"

namespace overt {

/// Attributes 0 to 2 as of MeshBuffers, 3 the place on the picture, 4 the colour of the corner, linear. The
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
