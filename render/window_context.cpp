#include "render/window_context.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "experiment/error.h"
#include "render/window_keys.h"

namespace overt {

namespace {

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

/// GLFW is one per process; it stays initialised while any window lives.
struct GlfwLibrary {
    static inline int users = 0;
    GlfwLibrary() {
        if (users == 0)
            initialise();
        ++users;
    }
    ~GlfwLibrary() {
        if (--users == 0)
            glfwTerminate();
    }

  private:
    /// An X server without a desktop starts anew when its last client leaves (Xvfb does), and takes no
    /// clients for a moment.
    static void initialise() {
        constexpr int attempts = 20;
        for (int attempt = 1; !glfwInit(); ++attempt) {
            if (attempt == attempts || !display_is_available())
                throw GraphicsError(fmt::format("GLFW: {}", last_glfw_error()));
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
};

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

std::string listed(const std::vector<GLFWmonitor*>& monitors) {
    std::string list;
    for (std::size_t i = 0; i < monitors.size(); ++i)
        list += "\n  " + describe(info_of(monitors[i], static_cast<int>(i) + 1));
    return monitors.empty() ? "\n  none" : list;
}

GLFWmonitor* monitor_numbered(int number) {
    const std::vector<GLFWmonitor*> monitors = all_monitors();
    if (number < 1 || number > static_cast<int>(monitors.size()))
        throw InputError(fmt::format("there is no monitor {}. There are:{}", number, listed(monitors)));
    return monitors[static_cast<std::size_t>(number) - 1];
}

bool shows(GLFWmonitor* monitor, glm::ivec2 size_px) { return info_of(monitor, 1).size_px == size_px; }

/// The monitor that is to be filled, which must have the resolution already: a change of mode of our own
/// might scale, and would have to be undone.
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

/// The monitor under the middle of a window; the primary one if none is.
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

} // namespace

struct WindowContext::State {
    GlfwLibrary library;
    GLFWwindow* window = nullptr;
    // A ring, so that a key pressed in the middle of a presentation allocates nothing.
    std::array<WindowKeyPress, 64> presses{};
    std::size_t first = 0, count = 0;
    glm::dvec2 pointer_px{0.0};
    Dragging dragging;
    // What is held still, and what became of it.
    bool held = false;
    glm::ivec2 held_framebuffer_px{0};
    GLFWmonitor* held_monitor = nullptr;
    WindowDisturbance disturbance = WindowDisturbance::none;
    ~State() {
        if (window)
            glfwDestroyWindow(window);
    }

    void disturb(WindowDisturbance what) {
        if (held && disturbance == WindowDisturbance::none)
            disturbance = what;
    }

    static void on_size(GLFWwindow* window, int width, int height) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        if (glm::ivec2(width, height) != state.held_framebuffer_px)
            state.disturb(WindowDisturbance::resized);
    }

    static void on_position(GLFWwindow* window, int x, int y) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        if (!state.held || state.disturbance != WindowDisturbance::none)
            return;
        if (all_monitors().empty() || !monitor_is_there(state.held_monitor)) {
            state.disturb(WindowDisturbance::screen_lost);
            return;
        }
        if (GLFWmonitor* const filled = glfwGetWindowMonitor(window)) {
            if (info_of(filled, 1).position_px != glm::ivec2(x, y))
                state.disturb(WindowDisturbance::moved);
        } else if (monitor_under(window) != state.held_monitor) {
            state.disturb(WindowDisturbance::moved);
        }
    }

    static bool monitor_is_there(GLFWmonitor* monitor) {
        const std::vector<GLFWmonitor*> monitors = all_monitors();
        return std::find(monitors.begin(), monitors.end(), monitor) != monitors.end();
    }

    static void on_pointer(GLFWwindow* window, double x, double y) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            state.dragging.by_px += glm::dvec2(x, y) - state.pointer_px;
        state.pointer_px = {x, y};
    }

    static void on_wheel(GLFWwindow* window, double, double steps) {
        static_cast<State*>(glfwGetWindowUserPointer(window))->dragging.wheel_steps += steps;
    }

    void push(const WindowKeyPress& press) {
        if (count < presses.size())
            presses[(first + count++) % presses.size()] = press;
    }

    static void on_key(GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action != GLFW_RELEASE)
            static_cast<State*>(glfwGetWindowUserPointer(window))
                ->push({window_key_of(key, modifiers), 0, action == GLFW_REPEAT});
    }

    static void on_character(GLFWwindow* window, unsigned character) {
        static_cast<State*>(glfwGetWindowUserPointer(window))
            ->push({WindowKey::character, static_cast<char32_t>(character)});
    }
};

WindowContext::WindowContext(const WindowRequest& request) : state_(std::make_unique<State>()) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, request.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    for (const int channel : {GLFW_RED_BITS, GLFW_GREEN_BITS, GLFW_BLUE_BITS})
        glfwWindowHint(channel, request.bits_per_channel);
    glfwWindowHint(GLFW_ALPHA_BITS, request.bits_per_channel == 10 ? 2 : 8);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
    // An operator who clicks on another screen must not make the observer's vanish.
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    GLFWmonitor* monitor = request.fullscreen ? monitor_to_fill(request) : nullptr;
    GLFWmonitor* const corner = request.monitor ? monitor_numbered(*request.monitor) : nullptr;
    // Put into its place before it is seen.
    if (corner && !request.fullscreen)
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    state_->window =
        glfwCreateWindow(request.size_px.x, request.size_px.y, request.title.c_str(), monitor, nullptr);
    if (!state_->window)
        throw GraphicsError(fmt::format("GLFW: {}", last_glfw_error()));
    if (corner && !request.fullscreen) {
        const glm::ivec2 place = info_of(corner, 1).position_px;
        glfwSetWindowPos(state_->window, place.x, place.y);
        if (request.visible)
            glfwShowWindow(state_->window);
    }
    glfwSetWindowUserPointer(state_->window, state_.get());
    glfwSetFramebufferSizeCallback(state_->window, &State::on_size);
    glfwSetWindowPosCallback(state_->window, &State::on_position);
    glfwSetKeyCallback(state_->window, &State::on_key);
    glfwSetCharCallback(state_->window, &State::on_character);
    glfwGetCursorPos(state_->window, &state_->pointer_px.x, &state_->pointer_px.y);
    glfwSetCursorPosCallback(state_->window, &State::on_pointer);
    glfwSetScrollCallback(state_->window, &State::on_wheel);
    if (request.fullscreen)
        glfwSetInputMode(state_->window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    make_current();
    load_functions(glfwGetProcAddress, ContextKind::window, "GLFW window");
    if (framebuffer_px() != request.size_px) {
        throw GraphicsError(
            fmt::format("the window shows {} x {} pixels where {} x {} were asked for: the desktop scales "
                        "it, which would resample every stimulus; set the scaling to 100 %",
                        framebuffer_px().x, framebuffer_px().y, request.size_px.x, request.size_px.y));
    }
}

WindowContext::~WindowContext() = default;

void WindowContext::make_current() { glfwMakeContextCurrent(state_->window); }

glm::ivec2 WindowContext::framebuffer_px() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

int WindowContext::bits_per_channel() const {
    GLint bits = 0;
    gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl().GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_BACK_LEFT,
                                             GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE, &bits);
    return bits;
}

void WindowContext::set_swap_interval(int refreshes) { glfwSwapInterval(refreshes); }

void WindowContext::swap_buffers() noexcept { glfwSwapBuffers(state_->window); }

void WindowContext::poll_events() noexcept { glfwPollEvents(); }

bool WindowContext::next_key_press(WindowKeyPress& press) noexcept {
    if (state_->count == 0)
        return false;
    press = state_->presses[state_->first];
    state_->first = (state_->first + 1) % state_->presses.size();
    --state_->count;
    return true;
}

WindowContext::Dragging WindowContext::take_dragging() noexcept {
    return std::exchange(state_->dragging, {});
}

bool WindowContext::close_requested() const noexcept { return glfwWindowShouldClose(state_->window) != 0; }

glm::ivec2 WindowContext::window_size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(state_->window, &size.x, &size.y);
    return size;
}

MonitorInfo WindowContext::monitor() const {
    GLFWmonitor* const monitor = monitor_under(state_->window);
    if (!monitor)
        throw GraphicsError("the window is on no monitor: the window system has none");
    const std::vector<GLFWmonitor*> monitors = all_monitors();
    const auto at = std::find(monitors.begin(), monitors.end(), monitor);
    return info_of(monitor, 1 + static_cast<int>(at - monitors.begin()));
}

GammaRamp WindowContext::gamma_ramp() const { return ramp_of(monitor_under(state_->window)); }

bool WindowContext::is_fullscreen() const noexcept { return glfwGetWindowMonitor(state_->window) != nullptr; }

NativeWindow WindowContext::native() const {
    return native_window_of(state_->window, monitor_under(state_->window));
}

void WindowContext::hold_still() {
    poll_events(); // what was under way
    state_->held_framebuffer_px = framebuffer_px();
    state_->held_monitor = monitor_under(state_->window);
    state_->disturbance = WindowDisturbance::none;
    state_->held = true;
}

WindowDisturbance WindowContext::disturbance() const noexcept { return state_->disturbance; }

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
