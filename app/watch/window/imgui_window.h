/// A window with Dear ImGui in it.
#pragma once

#include <functional>

#include "render/gl/gl_context.h"

struct GLFWwindow;

namespace overt {

/// One at a time, on one thread. Its context is current on that thread.
class ImguiWindow final : public GlContext {
  public:
    /// Throws GraphicsError if there is no display or no OpenGL 3.3.
    ImguiWindow(int width_px, int height_px, const char* title);
    ~ImguiWindow() override;

    void make_current() override;
    bool is_closed() const;
    /// Lays out and draws a frame, which is not shown yet.
    void draw(const std::function<void(float width, float height)>& lay_out);
    /// Has `draw_over` draw over the frame drawn last, once, and returns when it is on its way to the screen
    /// with nothing left to draw.
    void show(const std::function<void(glm::ivec2 window_px)>& draw_over);

  private:
    GLFWwindow* window_ = nullptr;
    glm::ivec2 size_px_{0}; ///< of the frame drawn last
};

} // namespace overt
