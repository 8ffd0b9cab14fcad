/// The hidden pass: for each pixel the triangle that is nearest at its centre.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/shader_program.h"
#include "render/stimulus/mesh_buffers.h"
#include "render/stimulus/scene_view.h"

namespace overt {

class CoordinatePass {
  public:
    CoordinatePass(const GlContext& context, glm::ivec2 image_px);

    /// Triangle index + 1 for each pixel, top row first; 0 where there is no surface. Both sides of a
    /// triangle count.
    std::vector<std::uint32_t> draw(const MeshBuffers& mesh, const SceneView& scene, const ObjectPose& angle);

    /// Draws into the target and leaves it there, for an asynchronous read. Allocates and throws nothing.
    void render(const MeshBuffers& mesh, const glm::mat4& clip_from_object) noexcept;

    /// What render() drew: triangle index + 1, as R32UI in colour attachment 0.
    const Framebuffer& target() const { return target_; }

  private:
    const GlContext* context_;
    ShaderProgram program_;
    Framebuffer target_;
};

} // namespace overt
