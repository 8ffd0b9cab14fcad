/// A mesh on the graphics card, drawn by triangle number.
#pragma once

#include <span>
#include <vector>

#include "experiment/scene/mesh.h"
#include "render/gl/gl_objects.h"

namespace overt {

/// For each vertex: xyz the mean direction (not normalised) in which nothing of the figure is in the way, w
/// the share of the hemisphere that is open, weighted by the cosine.
std::vector<glm::vec4> openness_of_vertices(const Mesh& mesh);

/// Attributes 0 position about the centre of the bounding box, 1 normal, 2 openness. gl_PrimitiveID is the
/// mesh's triangle index.
class MeshBuffers {
  public:
    /// For the hidden pass alone.
    MeshBuffers(const GlContext& context, const Mesh& mesh);
    /// With what the stimulus needs to be lit; `openness` as long as the mesh's positions.
    MeshBuffers(const GlContext& context, const Mesh& mesh, std::span<const glm::vec4> openness);

    void draw() const;

    /// What was subtracted from all positions.
    glm::dvec3 centre() const { return centre_; }

    /// As it was given; empty for the hidden pass alone.
    std::span<const glm::vec4> openness() const { return openness_; }

    /// No edge is open: back faces are never seen from outside.
    bool is_closed() const { return is_closed_; }

  private:
    const GlContext* context_;
    VertexArray array_;
    std::vector<Buffer> buffers_;
    GLsizei index_count_;
    glm::dvec3 centre_;
    std::vector<glm::vec4> openness_;
    bool is_closed_ = false;
};

} // namespace overt
