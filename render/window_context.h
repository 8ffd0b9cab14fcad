/// A window with a context, through GLFW. The window is the observer's screen: stimuli stand in it pixel by
/// pixel.
#pragma once

#include <memory>
#include <string>

#include "render/gl_context.h"

namespace overt {

struct WindowRequest {
    glm::ivec2 size_px{1920, 1080};
    std::string title = "overt";
    bool fullscreen = false; ///< on the monitor whose resolution is size_px; throws if there is none
    bool visible = true;
    int bits_per_channel = 8; ///< of the framebuffer, 8 or 10; what came of it is bits_per_channel()
};

/// Keys that a window reports.
enum class WindowKey { space, enter, escape, other };
struct WindowKeyPress {
    WindowKey key;
};

/// GLFW allows windows on the main thread only: construct, use and destroy this there.
class WindowContext final : public GlContext {
  public:
    /// Throws GraphicsError if there is no display, no context of 3.3 core, or if the window's framebuffer
    /// does not come out at the size asked for (a display scaling that would resample stimuli).
    explicit WindowContext(const WindowRequest& request);
    ~WindowContext() override;
    void make_current() override;

    glm::ivec2 framebuffer_px() const;

    /// Of red in the window's framebuffer.
    int bits_per_channel() const;

    /// 0: do not wait for the vertical blank; 1: wait for the next.
    void set_swap_interval(int refreshes);

    void swap_buffers() noexcept;

    /// Takes pending events; key presses are queued for next_key_press().
    void poll_events() noexcept;
    bool next_key_press(WindowKeyPress& press) noexcept;
    bool close_requested() const noexcept;

    /// The monitor's nominal refresh rate, 0 if it does not say.
    double monitor_refresh_hz() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
