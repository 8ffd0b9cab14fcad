#include "render/window/native_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#define GLFW_EXPOSE_NATIVE_X11
#define GLFW_EXPOSE_NATIVE_GLX
#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3native.h>

namespace overt {

NativeWindow native_monitor_of(GLFWmonitor* monitor) {
    NativeWindow native;
    if (Display* const display = glfwGetX11Display()) {
        native.x11_display = display;
        native.x11_server = XDisplayString(display);
        native.x11_window = static_cast<std::uint32_t>(DefaultRootWindow(display));
        if (monitor) {
            native.randr_output = static_cast<std::uint32_t>(glfwGetX11Monitor(monitor));
            native.randr_crtc = static_cast<std::uint32_t>(glfwGetX11Adapter(monitor));
        }
    }
    return native;
}

NativeWindow native_window_of(GLFWwindow* window, GLFWmonitor* monitor) {
    NativeWindow native = native_monitor_of(monitor);
    native.function = glfwGetProcAddress;
    native.x11_window = static_cast<std::uint32_t>(glfwGetX11Window(window));
    // A window has a context of one of the two.
    if (glfwGetWindowAttrib(window, GLFW_CONTEXT_CREATION_API) == GLFW_NATIVE_CONTEXT_API) {
        native.glx_drawable = static_cast<std::uint32_t>(glfwGetGLXWindow(window));
    } else {
        native.egl_display = glfwGetEGLDisplay();
        native.egl_surface = glfwGetEGLSurface(window);
    }
    return native;
}

} // namespace overt
