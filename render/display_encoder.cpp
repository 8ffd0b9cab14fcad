#include "render/display_encoder.h"

#include "experiment/error.h"
#include "render_shaders.h"

namespace overt {

namespace {

int shader_mode(OutputMode mode) {
    switch (mode) {
    case OutputMode::native_8bit:
        return 0;
    case OutputMode::mono_plus_plus:
        return 1;
    case OutputMode::color_plus_plus:
        return 2;
    }
    return 0;
}

} // namespace

DisplayEncoder::DisplayEncoder(const GlContext& context, OutputMode mode, double gamma)
    : context_(&context), program_(context, "display encoder", embedded::encode_vert, embedded::encode_frag),
      no_attributes_(context), mode_(mode), inverse_gamma_(static_cast<float>(1.0 / gamma)) {
    OVERT_EXPECTS(gamma > 0.0);
}

void DisplayEncoder::encode(const Texture2D& linear_light, const Framebuffer& target) const {
    OVERT_EXPECTS(linear_light.size_px() == target.size_px());
    const GladGLContext& gl = context_->gl();
    target.bind();
    for (const GLenum state :
         {GL_BLEND, GL_DITHER, GL_MULTISAMPLE, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST}) {
        gl.Disable(state);
    }
    program_.use();
    program_.set("linear_light", 0);
    program_.set("mode", shader_mode(mode_));
    program_.set("inverse_gamma", inverse_gamma_);
    linear_light.bind(0);
    no_attributes_.bind();
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    throw_on_gl_error(*context_, "encoding a picture for the display");
}

} // namespace overt
