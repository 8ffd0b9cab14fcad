#include "render/signal/signal_pass.h"

#include "experiment/base/error.h"
#include "render/signal/dither_tile.h"
#include "signal_shaders.h"

namespace overt {

SignalPass::SignalPass(const GlContext& context, const DisplaySettings& display)
    : context_(&context), program_(context, "last step", embedded::encode_vert, embedded::signal_frag),
      no_attributes_(context), ranks_(context, glm::ivec2(dither_tile_px), PixelFormat::r32ui),
      mode_(row_of(display.output)), dithered_(display.dither != Dithering::none) {
    if (dithered_) {
        const std::vector<std::uint32_t> tile = make_dither_tile(display.dither);
        ranks_.upload(std::as_bytes(std::span(tile)));
    }
}

void SignalPass::draw(const Texture2D& codes, const Framebuffer& target,
                      std::int64_t refresh) const noexcept {
    OVERT_EXPECTS(codes.size_px() == target.size_px());
    const GladGLContext& gl = context_->gl();
    target.bind();
    for (const GLenum state :
         {GL_BLEND, GL_DITHER, GL_MULTISAMPLE, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(state);
    program_.use();
    program_.set("codes", 0);
    program_.set("ranks", 1);
    program_.set("levels", mode_.levels);
    program_.set("dithered", dithered_ ? 1 : 0);
    program_.set("refresh", static_cast<int>(refresh & 4095));
    codes.bind(0);
    ranks_.bind(1);
    no_attributes_.bind();
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace overt
