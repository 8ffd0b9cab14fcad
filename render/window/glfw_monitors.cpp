#include "render/window/glfw_monitors.h"
#include "render/window/window_system.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/window/monitor_choice.h"
#include "render/window/screen_output.h"

namespace overt {
namespace {

int library_users = 0;

/// An X server without a desktop starts anew when its last client leaves (Xvfb does), and takes no clients
/// for a moment.
void initialise_library() {
    constexpr int attempts = 20;
    for (int attempt = 1; !glfwInit(); ++attempt) {
        const WindowSystem system = examine_window_system();
        if (system.is_wayland && !system.is_x11)
            throw GraphicsError(fmt::format(
                "windows need an X server, and there is none here (DISPLAY names none that answers): "
                "{}; without a window, --context osmesa draws unseen",
                system.go_between()));
        if (attempt == attempts || !display_is_available())
            throw GraphicsError(
                fmt::format("the desktop cannot be reached ({}): start overt from a desktop session, or set "
                            "DISPLAY or WAYLAND_DISPLAY to one; without one, --context osmesa draws unseen",
                            last_glfw_error()));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

std::vector<MonitorInfo> infos_of(const std::vector<GLFWmonitor*>& monitors) {
    std::vector<MonitorInfo> list;
    for (GLFWmonitor* monitor : monitors)
        list.push_back(info_of(monitor, static_cast<int>(list.size()) + 1));
    return list;
}

GLFWmonitor* monitor_as_wished(const MonitorWish& wish) {
    const std::vector<GLFWmonitor*> monitors = all_monitors();
    const std::vector<MonitorInfo> infos = infos_of(monitors);
    return monitors[static_cast<std::size_t>(choose_monitor(infos, wish).number) - 1];
}

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
    const ScreenOutput output = examine_output(native_monitor_of(monitor));
    info.edid_name = output.edid_name;
    if (output.refresh_hz) {
        info.refresh_hz = *output.refresh_hz;
        info.rate_is_exact = true;
    }
    glfwGetMonitorPos(monitor, &info.position_px.x, &info.position_px.y);
    glfwGetMonitorPhysicalSize(monitor, &info.size_mm.x, &info.size_mm.y);
    glfwGetMonitorContentScale(monitor, &info.content_scale.x, &info.content_scale.y);
    return info;
}

GLFWmonitor* monitor_called(const std::string& which) { return monitor_as_wished({.which = which}); }

GLFWmonitor* monitor_to_fill(const WindowRequest& request) {
    return monitor_as_wished(
        {.which = request.monitor, .size_px = request.size_px, .refresh_hz = request.refresh_hz});
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
    GammaRamp read{channel(ramp->red), channel(ramp->green), channel(ramp->blue), server_gamma()};
    // A server without a screen gives whatever stands in its memory: by no such table could one see anything.
    const auto is_table = [](const std::vector<std::uint16_t>& values) {
        return values.front() != values.back() &&
               (std::ranges::is_sorted(values) || std::ranges::is_sorted(values, std::ranges::greater()));
    };
    if (!is_table(read.red) || !is_table(read.green) || !is_table(read.blue))
        read.red = read.green = read.blue = {};
    return read;
}

std::vector<MonitorInfo> list_monitors() {
    const GlfwLibrary library;
    return infos_of(all_monitors());
}

GammaRamp gamma_ramp_of(int monitor) {
    const GlfwLibrary library;
    return ramp_of(monitor_called(std::to_string(monitor)));
}

std::string describe_rate(const MonitorInfo& monitor) {
    if (monitor.refresh_hz <= 0.0)
        return "an unknown rate";
    return monitor.rate_is_exact ? fmt::format("{:.2f} Hz", monitor.refresh_hz)
                                 : fmt::format("{:.0f} Hz", monitor.refresh_hz);
}

std::string describe(const MonitorInfo& monitor) {
    return fmt::format("monitor {} ({}{}, {} x {} px at {})", monitor.number,
                       monitor.name.empty() ? "no name" : monitor.name,
                       monitor.edid_name.empty() ? "" : ", " + monitor.edid_name, monitor.size_px.x,
                       monitor.size_px.y, describe_rate(monitor));
}

} // namespace overt
