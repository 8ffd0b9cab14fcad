/// A window with a context, through GLFW. The window is the observer's screen: stimuli stand in it pixel by
/// pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/gl_context.h"
#include "render/window/native_window.h"
#include "render/window/server_gamma.h"
#include "render/window/window_inputs.h"

namespace overt {

struct WindowRequest {
    glm::ivec2 size_px{1920, 1080};
    std::string title = "overt";
    bool fullscreen = false; ///< on the monitor whose resolution is size_px; throws if there is no single one
    bool visible = true;
    int bits_per_channel = 8; ///< of the framebuffer, 8 or 10; what came of it is bits_per_channel()
    /// See MonitorWish::which: a whole screen takes this one, a window stands in its top left corner. Empty:
    /// the only one of that resolution and rate; wherever the desktop puts a window.
    std::string monitor = {};
    /// Tells monitors of one resolution apart. The window asks for no other rate than the monitor has now.
    std::optional<double> refresh_hz = {};
    bool has_two_eyes = false; ///< with a buffer for each eye, which few graphics cards offer
};

/// Keys that a window reports. f1 to f12 lie together.
enum class WindowKey : std::uint8_t {
    space,
    enter,
    escape,
    left,
    right,
    up,
    down,
    tab,
    back_tab,
    backspace,
    page_up,
    page_down,
    pause,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    character, ///< what a key or several wrote; comes besides the key's own press
    other
};
struct WindowKeyPress {
    WindowKey key;
    char32_t character = 0;   ///< of WindowKey::character
    bool is_repeated = false; ///< the key is held
    int code = 0;      ///< the system's scancode of the key, of a character that of the key that wrote it
    int glfw_key = -1; ///< by GLFW's number; -1: it knows no such key
    int modifiers = 0; ///< held with it, GLFW's bits
};

/// A screen as the window system knows it.
struct MonitorInfo {
    int number = 1;             ///< the first is the primary one
    std::string name;           ///< of the output that it is connected to, such as "DP-1"; under X11 RandR's
    std::string edid_name;      ///< its own, as its EDID has it ("Display++"); empty if that cannot be read
    glm::ivec2 size_px{0};      ///< of the mode it shows now
    glm::ivec2 position_px{0};  ///< of its top left corner on the desktop
    double refresh_hz = 0.0;    ///< of that mode; 0 if it does not say
    bool rate_is_exact = false; ///< from the mode's pixel clock and totals, not a whole number
    glm::ivec2 size_mm{0};      ///< by its own word, often wrong; 0 if it does not say
    glm::vec2 content_scale{1.0f}; ///< by which the desktop enlarges what it draws
};

/// All of them. Throws GraphicsError if there is no window system. Main thread only.
std::vector<MonitorInfo> list_monitors();

/// "119.98 Hz", or "120 Hz" where only a whole rate is known, or "an unknown rate".
std::string describe_rate(const MonitorInfo& monitor);

/// "monitor 2 (DP-1, Display++, 1920 x 1080 px at 119.98 Hz)".
std::string describe(const MonitorInfo& monitor);

/// The system's table from a channel's value to what is sent, in 16 bits; empty if it cannot be read.
struct GammaRamp {
    std::vector<std::uint16_t> red, green, blue;
    /// What an X server reckons into the table besides and does not tell as part of it: as xgamma sets it.
    ServerGamma server_gamma = {};
    bool operator==(const GammaRamp&) const = default;
};

/// Of a monitor by its number in list_monitors(). Main thread only.
GammaRamp gamma_ramp_of(int monitor);

/// What must not happen to a window while a session shows it.
enum class WindowDisturbance : std::uint8_t { none, resized, moved, screen_lost };

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
    /// Presses, releases, characters, the pointer: beside the presses of next_key_press(), and in their
    /// order.
    bool next_input(WindowInput& input) noexcept;
    bool close_requested() const noexcept;

    /// Whether a full screen shows the mouse's pointer; it does not, until it is told. A pointer that is
    /// elsewhere then comes to the middle of the window. A window that is no full screen always shows it.
    void show_pointer(bool is_shown) noexcept;

    /// It had the keyboard, and another window has it now; as of poll_events().
    bool has_lost_focus() const noexcept;

    /// What the mouse has done since the last call: its way in pixels while its left button was held (right
    /// and down are positive), and the wheel's steps (away from the user is positive).
    struct Dragging {
        glm::dvec2 by_px{0.0};
        double wheel_steps = 0.0;
        /// Where its left button was pressed and let go without a way; of more clicks the first ones.
        std::array<glm::dvec2, 8> clicks_px{};
        std::size_t click_count = 0;
    };
    Dragging take_dragging() noexcept;

    /// The window's own size, in the desktop's units.
    glm::ivec2 window_size() const;

    /// The monitor on which the middle of the window is.
    MonitorInfo monitor() const;
    GammaRamp gamma_ramp() const; ///< of that monitor

    bool is_fullscreen() const noexcept;

    /// As the systems below know it, for what they can tell of its refreshes.
    NativeWindow native() const;

    /// From now on the window has to stay as and where it is: disturbance() says what happened first. A whole
    /// screen must not move at all, a window must stay on its monitor.
    void hold_still();
    WindowDisturbance disturbance() const noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
