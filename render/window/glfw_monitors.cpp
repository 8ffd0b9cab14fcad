#include "render/window/glfw_monitors.h"
#include "render/window/window_system.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

int library_users = 0;

/// An X server without a desktop starts anew when its last client leaves (Xvfb does), and takes no clients
/// for a moment.
void initialise_library() {
    constexpr int attempts = 20;
    for (int attempt = 1; !glfwInit(); ++attempt) {
        if (attempt == attempts || !display_is_available())
            throw GraphicsError(
                fmt::format("the desktop cannot be reached ({}): start overt from a desktop session, or set "
                            "DISPLAY or WAYLAND_DISPLAY to one; without one, --context osmesa draws unseen",
                            last_glfw_error()));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

std::string listed(const std::vector<GLFWmonitor*>& monitors) {
    std::string list;
    for (std::size_t i = 0; i < monitors.size(); ++i)
        list += "\n  " + describe(info_of(monitors[i], static_cast<int>(i) + 1));
    return monitors.empty() ? "\n  none" : list;
}

bool shows(GLFWmonitor* monitor, glm::ivec2 size_px) { return info_of(monitor, 1).size_px == size_px; }

} // namespace

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

GlfwLibrary::GlfwLibrary() {
    if (library_users == 0)
        initialise_library();
    ++library_users;
}

GlfwLibrary::~GlfwLibrary() {
    if (--library_users == 0)
        glfwTerminate();
}

std::vector<GLFWmonitor*> all_monitors() {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return {monitors, monitors + count};
}

MonitorInfo info_of(GLFWmonitor* monitor, int number) {
    MonitorInfo info;
    info.number = number;
    if (const char* name = glfwGetMonitorName(monitor))
        info.name = name;
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) {
        info.size_px = {mode->width, mode->height};
        info.refresh_hz = std::max(0, mode->refreshRate);
    }
    glfwGetMonitorPos(monitor, &info.position_px.x, &info.position_px.y);
    glfwGetMonitorPhysicalSize(monitor, &info.size_mm.x, &info.size_mm.y);
    glfwGetMonitorContentScale(monitor, &info.content_scale.x, &info.content_scale.y);
    return info;
}

GLFWmonitor* monitor_numbered(int number) {
    const std::vector<GLFWmonitor*> monitors = all_monitors();
    if (number < 1 || number > static_cast<int>(monitors.size()))
        throw InputError(fmt::format("there is no monitor {}. There are:{}", number, listed(monitors)));
    return monitors[static_cast<std::size_t>(number) - 1];
}

GLFWmonitor* monitor_to_fill(const WindowRequest& request) {
    const int width = request.size_px.x, height = request.size_px.y;
    if (request.monitor) {
        GLFWmonitor* const monitor = monitor_numbered(*request.monitor);
        if (shows(monitor, request.size_px))
            return monitor;
        throw GraphicsError(
            fmt::format("{} does not show {} x {} pixels now: set its mode, correct [display] "
                        "width_px and height_px, or take another. There are:{}",
                        describe(info_of(monitor, *request.monitor)), width, height, listed(all_monitors())));
    }
    for (GLFWmonitor* monitor : all_monitors())
        if (shows(monitor, request.size_px))
            return monitor;
    throw GraphicsError(fmt::format("no monitor shows {} x {} pixels now: set its mode, or correct [display] "
                                    "width_px and height_px. There are:{}",
                                    width, height, listed(all_monitors())));
}

GLFWmonitor* monitor_under(GLFWwindow* window) {
    if (GLFWmonitor* const filled = glfwGetWindowMonitor(window))
        return filled;
    glm::ivec2 corner(0), size(0);
    glfwGetWindowPos(window, &corner.x, &corner.y);
    glfwGetWindowSize(window, &size.x, &size.y);
    const glm::ivec2 middle = corner + size / 2;
    for (GLFWmonitor* monitor : all_monitors()) {
        const MonitorInfo info = info_of(monitor, 1);
        const glm::ivec2 in = middle - info.position_px;
        if (in.x >= 0 && in.y >= 0 && in.x < info.size_px.x && in.y < info.size_px.y)
            return monitor;
    }
    return glfwGetPrimaryMonitor();
}

GammaRamp ramp_of(GLFWmonitor* monitor) {
    const GLFWgammaramp* const ramp = monitor ? glfwGetGammaRamp(monitor) : nullptr;
    if (!ramp || ramp->size == 0)
        return {};
    const auto channel = [&](const unsigned short* values) {
        return std::vector<std::uint16_t>(values, values + ramp->size);
    };
    const GammaRamp read{channel(ramp->red), channel(ramp->green), channel(ramp->blue)};
    // A server without a screen gives whatever stands in its memory: by no such table could one see anything.
    const auto is_table = [](const std::vector<std::uint16_t>& values) {
        return values.front() != values.back() &&
               (std::ranges::is_sorted(values) || std::ranges::is_sorted(values, std::ranges::greater()));
    };
    return is_table(read.red) && is_table(read.green) && is_table(read.blue) ? read : GammaRamp{};
}

std::vector<MonitorInfo> list_monitors() {
    const GlfwLibrary library;
    std::vector<MonitorInfo> list;
    for (GLFWmonitor* monitor : all_monitors())
        list.push_back(info_of(monitor, static_cast<int>(list.size()) + 1));
    return list;
}

GammaRamp gamma_ramp_of(int monitor) {
    const GlfwLibrary library;
    return ramp_of(monitor_numbered(monitor));
}

std::string describe(const MonitorInfo& monitor) {
    return fmt::format("monitor {} ({}, {} x {} px at {})", monitor.number,
                       monitor.name.empty() ? "no name" : monitor.name, monitor.size_px.x, monitor.size_px.y,
                       monitor.refresh_hz > 0 ? fmt::format("{} Hz", monitor.refresh_hz)
                                              : std::string("an unknown rate"));
}

} // namespace overt
