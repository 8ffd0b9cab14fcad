#include "render/window_context.h"

#include <array>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "experiment/error.h"

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
        if (users == 0 && !glfwInit())
            throw GraphicsError(fmt::format("GLFW: {}", last_glfw_error()));
        ++users;
    }
    ~GlfwLibrary() {
        if (--users == 0)
            glfwTerminate();
    }
};

GLFWmonitor* monitor_of_size(glm::ivec2 size_px) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode && mode->width == size_px.x && mode->height == size_px.y)
            return monitors[i];
    }
    throw GraphicsError(fmt::format("no monitor shows {} x {} pixels now: set its mode, or correct [display] "
                                    "width_px and height_px",
                                    size_px.x, size_px.y));
}

} // namespace

struct WindowContext::State {
    GlfwLibrary library;
    GLFWwindow* window = nullptr;
    // A ring, so that a key pressed in the middle of a presentation allocates nothing.
    std::array<WindowKeyPress, 64> presses{};
    std::size_t first = 0, count = 0;
    ~State() {
        if (window)
            glfwDestroyWindow(window);
    }

    static void on_key(GLFWwindow* window, int key, int, int action, int) {
        if (action != GLFW_PRESS)
            return;
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        if (state.count == state.presses.size())
            return;
        const WindowKey pressed = key == GLFW_KEY_SPACE    ? WindowKey::space
                                  : key == GLFW_KEY_ENTER  ? WindowKey::enter
                                  : key == GLFW_KEY_ESCAPE ? WindowKey::escape
                                                           : WindowKey::other;
        state.presses[(state.first + state.count++) % state.presses.size()] = {pressed};
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
    GLFWmonitor* monitor = request.fullscreen ? monitor_of_size(request.size_px) : nullptr;
    state_->window =
        glfwCreateWindow(request.size_px.x, request.size_px.y, request.title.c_str(), monitor, nullptr);
    if (!state_->window)
        throw GraphicsError(fmt::format("GLFW: {}", last_glfw_error()));
    glfwSetWindowUserPointer(state_->window, state_.get());
    glfwSetKeyCallback(state_->window, &State::on_key);
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

bool WindowContext::close_requested() const noexcept { return glfwWindowShouldClose(state_->window) != 0; }

double WindowContext::monitor_refresh_hz() const {
    GLFWmonitor* monitor = glfwGetWindowMonitor(state_->window);
    if (!monitor)
        monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    return mode && mode->refreshRate > 0 ? mode->refreshRate : 0.0;
}

} // namespace overt
