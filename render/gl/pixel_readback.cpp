#include "render/gl/pixel_readback.h"

#include <cstring>

#include "experiment/base/error.h"

namespace overt {

PixelReadback::PixelReadback(const GlContext& context, glm::ivec2 size_px, PixelFormat format)
    : context_(&context), size_px_(size_px), format_(format),
      buffer_(context, GL_PIXEL_PACK_BUFFER, bytes_in(size_px, format), GL_STREAM_READ) {
    context.gl().BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

PixelReadback::~PixelReadback() {
    if (fence_)
        context_->gl().DeleteSync(fence_);
}

void PixelReadback::start(const Framebuffer& from) noexcept {
    OVERT_EXPECTS(!fence_ && from.size_px() == size_px_);
    const GladGLContext& gl = context_->gl();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.name());
    const auto [format, type] = transfer_format(format_);
    gl.ReadPixels(0, 0, size_px_.x, size_px_.y, format, type, nullptr);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    fence_ = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.Flush();
}

bool PixelReadback::finish(std::span<std::byte> into, bool wait) noexcept {
    OVERT_EXPECTS(fence_ && into.size() == bytes_in(size_px_, format_));
    const GladGLContext& gl = context_->gl();
    constexpr GLuint64 ten_seconds_ns = 10'000'000'000;
    const GLenum state = gl.ClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, wait ? ten_seconds_ns : 0);
    if (state == GL_TIMEOUT_EXPIRED)
        return false;
    gl.DeleteSync(fence_);
    fence_ = nullptr;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.name());
    const void* pixels =
        gl.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(into.size()), GL_MAP_READ_BIT);
    if (pixels)
        std::memcpy(into.data(), pixels, into.size());
    gl.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return pixels != nullptr;
}

} // namespace overt
