/// Turns linear light into the bytes that the display reads: 8 bits as they are, Mono++ or Color++.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/gl_objects.h"
#include "render/shader_program.h"

namespace overt {

class DisplayEncoder {
  public:
    /// `gamma`: exponent between wire value and light.
    DisplayEncoder(const GlContext& context, OutputMode mode, double gamma);

    /// Draws `linear_light` (RGBA32F, the target's size, display RGB 0 … 1) encoded into `target` (RGBA8). In
    /// Color++ the picture must be shown from an even column of the screen on, for pairs of pixels count from
    /// the left edge.
    void encode(const Texture2D& linear_light, const Framebuffer& target) const;

  private:
    const GlContext* context_;
    ShaderProgram program_;
    VertexArray no_attributes_;
    OutputMode mode_;
    float inverse_gamma_;
};

} // namespace overt
