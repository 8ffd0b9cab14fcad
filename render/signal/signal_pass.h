/// The last step of the native modes on the graphics card: from 16-bit codes to the levels of the video
/// signal, with or without dithering.
#pragma once

#include <cstdint>

#include "render/gl/gl_objects.h"
#include "render/gl/shader_program.h"
#include "render/image/linear_image.h"

namespace overt {

class SignalPass {
  public:
    /// For a mode that is not packed.
    SignalPass(const GlContext& context, const DisplaySettings& display);

    /// What it draws into.
    PixelFormat format() const {
        return mode_.framebuffer_bits == 10 ? PixelFormat::rgb10_a2 : PixelFormat::rgba8;
    }

    /// Draws `codes` (RGBA16) into `target` of the same size. Every refresh has a dithering of its own; over
    /// 4096 in a row each pixel has the mean of its code. Allocates and throws nothing.
    void draw(const Texture2D& codes, const Framebuffer& target, std::int64_t refresh) const noexcept;

  private:
    const GlContext* context_;
    ShaderProgram program_;
    VertexArray no_attributes_;
    Texture2D ranks_;
    const OutputModeRow& mode_;
    bool dithered_;
};

} // namespace overt
