#include "render/window/window_context.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/window/glfw_monitors.h"
#include "render/window/window_keys.h"

namespace overt {

struct WindowContext::State {
    GlfwLibrary library;
    GLFWwindow* window = nullptr;
    // A ring, so that a key pressed in the middle of a presentation allocates nothing.
    std::array<WindowKeyPress, 64> presses{};
    std::size_t first = 0, count = 0;
    WindowInputs inputs;
    glm::ivec2 window_size{1}, framebuffer_px{1};
    bool is_pointer_shown = true;
    glm::dvec2 pointer_px{0.0}, pressed_px{0.0};
    Dragging dragging;
    // What is held still, and what became of it.
    bool held = false;
    glm::ivec2 held_framebuffer_px{0};
    GLFWmonitor* held_monitor = nullptr;
    WindowDisturbance disturbance = WindowDisturbance::none;
    bool has_lost_focus = false;
    // GLFW tells a held key by its own number alone: of keys that it does not know, by the scancode.
    std::bitset<1024> is_down;
    WindowKeyPress last_key{WindowKey::other};
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
        state.framebuffer_px = {width, height};
        if (glm::ivec2(width, height) != state.held_framebuffer_px)
            state.disturb(WindowDisturbance::resized);
    }

    static void on_window_size(GLFWwindow* window, int width, int height) {
        static_cast<State*>(glfwGetWindowUserPointer(window))->window_size = {width, height};
    }

    glm::dvec2 from_middle_px() const {
        return pointer_from_middle_px(pointer_px, window_size, framebuffer_px);
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

    static void on_focus(GLFWwindow* window, int has_it) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        state.has_lost_focus = has_it == GLFW_FALSE;
        if (state.has_lost_focus)
            state.inputs.push({.kind = ObserverInput::Kind::let_go});
        state.is_down.reset(); // what is let go elsewhere is not told
    }

    static void on_pointer(GLFWwindow* window, double x, double y) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            state.dragging.by_px += glm::dvec2(x, y) - state.pointer_px;
        state.pointer_px = {x, y};
        state.inputs.push(
            {.kind = ObserverInput::Kind::pointer_moved, .from_middle_px = state.from_middle_px()});
    }

    static void on_button(GLFWwindow* window, int button, int action, int) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        constexpr int left_middle_right[] = {1, 3, 2}; // by GLFW's numbers
        state.inputs.push({.kind = action == GLFW_PRESS ? ObserverInput::Kind::pointer_down
                                                        : ObserverInput::Kind::pointer_up,
                           .from_middle_px = state.from_middle_px(),
                           .button = button < 3 ? left_middle_right[button] : button + 1});
        if (button != GLFW_MOUSE_BUTTON_LEFT)
            return;
        constexpr double least_way_px = 4.0;
        if (action == GLFW_PRESS)
            state.pressed_px = state.pointer_px;
        else if (glm::distance(state.pressed_px, state.pointer_px) < least_way_px &&
                 state.dragging.click_count < state.dragging.clicks_px.size())
            state.dragging.clicks_px[state.dragging.click_count++] = state.pointer_px;
    }

    static void on_wheel(GLFWwindow* window, double, double steps) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        state.dragging.wheel_steps += steps;
        state.inputs.push(
            {.kind = ObserverInput::Kind::wheel, .from_middle_px = state.from_middle_px(), .steps = steps});
    }

    void push(const WindowKeyPress& press) {
        if (count < presses.size())
            presses[(first + count++) % presses.size()] = press;
    }

    /// Whether it was down already.
    bool set_down(int code, bool is_pressed) {
        if (code < 0 || static_cast<std::size_t>(code) >= is_down.size())
            return false;
        const auto at = static_cast<std::size_t>(code);
        const bool was_down = is_down[at];
        is_down[at] = is_pressed;
        return was_down;
    }

    static void on_key(GLFWwindow* window, int key, int code, int action, int modifiers) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        const bool was_down = state.set_down(code, action != GLFW_RELEASE);
        if (action == GLFW_RELEASE || (action == GLFW_PRESS && !was_down))
            state.inputs.push(
                {.kind = action == GLFW_RELEASE ? ObserverInput::Kind::key_up : ObserverInput::Kind::key_down,
                 .code = code,
                 .glfw_key = key});
        // Held, it goes on as keys that write do.
        if (action == GLFW_REPEAT && key == GLFW_KEY_BACKSPACE)
            state.inputs.push({.kind = ObserverInput::Kind::text, .character = U'\b', .is_repeated = true});
        if (action == GLFW_RELEASE)
            return;
        state.last_key = {
            window_key_of(key, modifiers), 0, action == GLFW_REPEAT || was_down, code, key, modifiers};
        state.push(state.last_key);
    }

    /// Comes after the key that wrote it.
    static void on_character(GLFWwindow* window, unsigned character) {
        auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
        WindowKeyPress written = state.last_key;
        written.key = WindowKey::character;
        written.character = static_cast<char32_t>(character);
        state.push(written);
        state.inputs.push({.kind = ObserverInput::Kind::text,
                           .character = written.character,
                           .is_repeated = written.is_repeated});
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
    glfwWindowHint(GLFW_STEREO, request.has_two_eyes ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
    // An operator who clicks on another screen must not make the observer's vanish.
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    GLFWmonitor* monitor = request.fullscreen ? monitor_to_fill(request) : nullptr;
    // Unless it is told a rate GLFW sets the highest one of that size, and leaves the mode the lab has
    // chosen.
    const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    glfwWindowHint(GLFW_REFRESH_RATE, mode && mode->refreshRate > 0 ? mode->refreshRate : GLFW_DONT_CARE);
    GLFWmonitor* const corner = request.monitor.empty() ? nullptr : monitor_called(request.monitor);
    // Put into its place before it is seen.
    if (corner && !request.fullscreen)
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    state_->window =
        glfwCreateWindow(request.size_px.x, request.size_px.y, request.title.c_str(), monitor, nullptr);
    if (!state_->window && request.has_two_eyes)
        throw GraphicsError(
            fmt::format("a window with a buffer for each eye (quad buffers) cannot be opened ({}): few "
                        "graphics cards and "
                        "drivers offer one. Use a stereoscope, with kind = \"mirrors\" under [stereo]",
                        last_glfw_error()));
    if (!state_->window)
        throw GraphicsError(fmt::format(
            "a window of {} x {} pixels cannot be opened ({}): it needs OpenGL 3.3 and {} bits per "
            "channel; `overt doctor` says what this desktop offers",
            request.size_px.x, request.size_px.y, last_glfw_error(), request.bits_per_channel));
    if (corner && !request.fullscreen) {
        const glm::ivec2 place = info_of(corner, 1).position_px;
        glfwSetWindowPos(state_->window, place.x, place.y);
        if (request.visible)
            glfwShowWindow(state_->window);
    }
    glfwSetWindowUserPointer(state_->window, state_.get());
    glfwGetWindowSize(state_->window, &state_->window_size.x, &state_->window_size.y);
    state_->framebuffer_px = framebuffer_px();
    glfwSetFramebufferSizeCallback(state_->window, &State::on_size);
    glfwSetWindowSizeCallback(state_->window, &State::on_window_size);
    glfwSetWindowPosCallback(state_->window, &State::on_position);
    glfwSetWindowFocusCallback(state_->window, &State::on_focus);
    glfwSetKeyCallback(state_->window, &State::on_key);
    glfwSetCharCallback(state_->window, &State::on_character);
    glfwGetCursorPos(state_->window, &state_->pointer_px.x, &state_->pointer_px.y);
    glfwSetCursorPosCallback(state_->window, &State::on_pointer);
    glfwSetMouseButtonCallback(state_->window, &State::on_button);
    glfwSetScrollCallback(state_->window, &State::on_wheel);
    show_pointer(false);
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

bool WindowContext::next_input(WindowInput& input) noexcept { return state_->inputs.next(input); }

void WindowContext::show_pointer(bool is_shown) noexcept {
    if (is_shown == state_->is_pointer_shown || !is_fullscreen())
        return;
    state_->is_pointer_shown = is_shown;
    const glm::dvec2 size(state_->window_size);
    glm::dvec2 at(0.0);
    glfwGetCursorPos(state_->window, &at.x, &at.y);
    if (is_shown && (at.x < 0.0 || at.y < 0.0 || at.x >= size.x || at.y >= size.y))
        glfwSetCursorPos(state_->window, 0.5 * size.x, 0.5 * size.y);
    glfwSetInputMode(state_->window, GLFW_CURSOR, is_shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

WindowContext::Dragging WindowContext::take_dragging() noexcept {
    return std::exchange(state_->dragging, {});
}

bool WindowContext::close_requested() const noexcept { return glfwWindowShouldClose(state_->window) != 0; }

bool WindowContext::has_lost_focus() const noexcept { return state_->has_lost_focus; }

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

} // namespace overt
