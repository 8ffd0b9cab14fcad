/// Pixels on their way from the graphics card to memory while the card and the program go on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/gl/gl_objects.h"

namespace overt {

/// One read under way at a time. After construction nothing here allocates or throws.
class PixelReadback {
  public:
    PixelReadback(const GlContext& context, glm::ivec2 size_px, PixelFormat format);
    ~PixelReadback();
    PixelReadback(PixelReadback&&) = delete;

    bool under_way() const noexcept { return fence_ != nullptr; }

    /// Begins to read colour attachment 0 of `from`, which has this size and format. Nothing may be under
    /// way.
    void start(const Framebuffer& from) noexcept;

    /// If the pixels have arrived, copies them and gives true. With `wait`, waits for them.
    bool finish(std::span<std::byte> into, bool wait) noexcept;

  private:
    const GlContext* context_;
    glm::ivec2 size_px_;
    PixelFormat format_;
    Buffer buffer_;
    GLsync fence_ = nullptr;
};

} // namespace overt
