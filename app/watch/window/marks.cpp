#include "app/watch/window/marks.h"

#include "watch_shaders.h"

namespace overt {

MarkPen::MarkPen(const GlContext& context)
    : context_(&context), program_(context, "mark", embedded::mark_vert, embedded::mark_frag),
      array_(context) {}

void MarkPen::draw(std::span<const Mark> marks, glm::ivec2 window_px) {
    if (marks.empty())
        return;
    static_assert(sizeof(Mark) == 8 * sizeof(float));
    const GladGLContext& gl = context_->gl();
    const Buffer buffer(*context_, GL_ARRAY_BUFFER, std::as_bytes(marks), GL_STREAM_DRAW);
    array_.bind();
    for (const GLuint index : {0u, 1u}) {
        gl.EnableVertexAttribArray(index);
        // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL has offsets as pointers
        const auto* const offset = reinterpret_cast<const void*>(index * 4 * sizeof(float));
        gl.VertexAttribPointer(index, 4, GL_FLOAT, GL_FALSE, sizeof(Mark), offset);
    }
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.Enable(GL_PROGRAM_POINT_SIZE);
    program_.use();
    program_.set("window_px", window_px);
    gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(marks.size()));
    gl.Disable(GL_BLEND);
}

} // namespace overt
