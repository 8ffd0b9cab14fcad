/// Marks of gaze, drawn over a frame that stands already.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "render/gl/gl_objects.h"
#include "render/gl/shader_program.h"

namespace overt {

/// A ring, or a disc.
struct Mark {
    glm::vec2 place_px{0.0f}; ///< from the window's top left
    float radius_px = 1.0f;
    float line_px = 0.0f; ///< width of a ring's line; 0: a disc
    glm::vec4 colour{1.0f};
};

class MarkPen {
  public:
    /// `context` must be current and outlive this.
    explicit MarkPen(const GlContext& context);
    /// Into the framebuffer that is bound, which is the window's.
    void draw(std::span<const Mark> marks, glm::ivec2 window_px);

  private:
    const GlContext* context_;
    ShaderProgram program_;
    VertexArray array_;
};

} // namespace overt
