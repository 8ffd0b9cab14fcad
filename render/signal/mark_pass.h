/// Draws marks over encoded pictures on the graphics card.
#pragma once

#include <array>
#include <vector>

#include "experiment/ports/stimulus_mark.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader_program.h"
#include "render/signal/display_encoder.h"

namespace overt {

/// A mark's pixels are its own alone: their light is encoded as that of pictures is, and edges are not
/// blended with what is there, which the signal would not allow in the modes that pack it. Lines are placed
/// to fractions of a pixel.
class MarkPass {
  public:
    MarkPass(const GlContext& context, const DisplaySettings& display);

    /// Encodes a light, if it is not known yet: before it is drawn with. Keeps the last few.
    void prepare(const std::array<double, 3>& light);

    /// Into a target in the encoder's format, within a patch of it; places of marks are of the target, top
    /// row first. One whose light was not prepared is not drawn. Allocates and throws nothing.
    void draw(const StimulusMark& mark, const Framebuffer& target, const ScreenPatch& within) noexcept;

  private:
    /// Of even and odd columns.
    using Ink = std::array<glm::vec4, 2>;
    struct KnownInk {
        std::array<double, 3> light;
        Ink ink;
    };
    Ink encoded(const std::array<double, 3>& light) const;
    const Ink* ink_of(const std::array<double, 3>& light) const noexcept;
    void draw_line(const MarkLine& line, double reach_px, const Ink& ink) noexcept;

    const GlContext* context_;
    DisplayEncoder encoder_;
    ShaderProgram program_;
    VertexArray no_attributes_;
    int joined_px_;
    Ink rim_;
    std::vector<KnownInk> inks_;
};

} // namespace overt
