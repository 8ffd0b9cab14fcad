#include "render/window_response_panel.h"

namespace overt {

void WindowResponsePanel::forget_presses() noexcept {
    window_->poll_events();
    WindowKeyPress press{};
    // An escape is remembered: it may have been pressed while something was prepared.
    while (window_->next_key_press(press))
        escape_pressed_ = escape_pressed_ || press.key == WindowKey::escape;
}

void WindowResponsePanel::await_key(SessionTime since) {
    forget_presses();
    if (answering_)
        answering_->await_key(since);
}

void WindowResponsePanel::await_response(const Trial& trial, SessionTime since) {
    forget_presses();
    if (answering_)
        answering_->await_response(trial, since);
}

std::optional<ResponsePress> WindowResponsePanel::poll() noexcept {
    window_->poll_events();
    WindowKeyPress press{};
    while (window_->next_key_press(press)) {
        escape_pressed_ = escape_pressed_ || press.key == WindowKey::escape;
        // GLFW's events carry no times of their own; this is within one polling interval of the press.
        if (press.key == WindowKey::space || press.key == WindowKey::enter)
            return ResponsePress{ResponsePress::Key::next, clock_->now()};
    }
    if (escape_pressed_)
        return ResponsePress{ResponsePress::Key::abort, clock_->now()};
    return answering_ ? answering_->poll() : std::nullopt;
}

} // namespace overt
