#include "render/stimulus/coordinate_pass.h"

#include "experiment/base/error.h"
#include "stimulus_shaders.h"

namespace overt {

CoordinatePass::CoordinatePass(const GlContext& context, glm::ivec2 image_px)
    : context_(&context),
      program_(context, "coordinate map", embedded::coordinate_vert, embedded::coordinate_frag),
      target_(context, image_px, PixelFormat::r32ui, true) {}

void CoordinatePass::render(const MeshBuffers& mesh, const glm::mat4& clip_from_object) noexcept {
    const GladGLContext& gl = context_->gl();
    target_.bind();
    draw_nearest_only(gl);
    const GLuint nothing[4] = {0, 0, 0, 0};
    const GLfloat far = 1.0f;
    gl.ClearBufferuiv(GL_COLOR, 0, nothing);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);
    program_.use();
    program_.set("clip_from_object", clip_from_object);
    mesh.draw();
    gl.Disable(GL_DEPTH_TEST);
}

std::vector<std::uint32_t> CoordinatePass::draw(const MeshBuffers& mesh, const SceneView& scene,
                                                const ObjectPose& angle) {
    OVERT_EXPECTS(scene.view.image_px == target_.size_px());
    render(mesh, clip_from_centred_object(scene, angle));
    std::vector<std::uint32_t> codes(static_cast<std::size_t>(target_.size_px().x) *
                                     static_cast<std::size_t>(target_.size_px().y));
    target_.read(PixelFormat::r32ui, std::as_writable_bytes(std::span(codes)));
    return codes;
}

} // namespace overt
