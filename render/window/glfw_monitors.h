/// The screens as GLFW knows them. Main thread only.
#pragma once

#include <string>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/window/window_context.h"

namespace overt {

/// GLFW's reason for what it has just refused.
std::string last_glfw_error();

/// GLFW is one per process; it stays initialised while any of these lives.
class GlfwLibrary {
  public:
    /// Throws GraphicsError if there is no window system.
    GlfwLibrary();
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

std::vector<GLFWmonitor*> all_monitors();

MonitorInfo info_of(GLFWmonitor* monitor, int number);

/// See MonitorWish::which. Throws InputError that lists those that there are.
GLFWmonitor* monitor_called(const std::string& which);

/// The monitor that a whole screen is to fill, which must have the resolution already: a change of mode of
/// our own might scale, and would have to be undone. Throws InputError if there is none, or no single one.
GLFWmonitor* monitor_to_fill(const WindowRequest& request);

/// The monitor under the middle of a window; the primary one if none is.
GLFWmonitor* monitor_under(GLFWwindow* window);

/// Empty if there is no monitor, or no table that one could see anything by.
GammaRamp ramp_of(GLFWmonitor* monitor);

} // namespace overt
