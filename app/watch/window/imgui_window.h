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
    /// Draws a frame and returns when it is on its way to the screen with nothing left to draw.
    void show(const std::function<void(float width, float height)>& draw);

  private:
    GLFWwindow* window_ = nullptr;
};

} // namespace overt
