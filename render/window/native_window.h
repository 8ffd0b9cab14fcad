/// A window as the systems below GLFW know it.
#pragma once

#include <cstdint>
#include <string>

struct GLFWwindow;
struct GLFWmonitor;

namespace overt {

/// What there is not is null or 0.
struct NativeWindow {
    void* x11_display = nullptr; ///< Display*, owned by GLFW
    std::string x11_server;      ///< by which another connection is made
    std::uint32_t x11_window = 0;
    std::uint32_t glx_drawable = 0;
    std::uint32_t randr_output = 0; ///< of the monitor the window is on
    std::uint32_t randr_crtc = 0;   ///< that feeds it
    void* egl_display = nullptr;
    void* egl_surface = nullptr;
    /// The function of GLX, EGL or OpenGL of this name; null if there is none. Needs a current context.
    void (*(*function)(const char* name))() = nullptr;
};

/// The server, its root window in the place of a window, and the monitor's output; nothing of a context. Main
/// thread only.
NativeWindow native_monitor_of(GLFWmonitor* monitor);

/// Main thread only; `monitor` may be null.
NativeWindow native_window_of(GLFWwindow* window, GLFWmonitor* monitor);

} // namespace overt
