#include "devices/simulated_response_panel.h"

namespace overt {

namespace {
constexpr SessionDuration pressed_again_after = std::chrono::seconds(1);
}

void SimulatedResponsePanel::await_key(SessionTime since) {
    next_press_ = since + observer_->reading_time(texts_read_++);
    answer_.clear();
}

void SimulatedResponsePanel::await_response(const Trial& trial, SessionTime since) {
    SimulatedAnswer answer = observer_->answer_to(trial);
    next_press_ = since + answer.after;
    answer_ = std::move(answer.text);
}

std::optional<ResponsePress> SimulatedResponsePanel::poll() noexcept {
    if (!next_press_ || clock_->now() < *next_press_)
        return std::nullopt;
    const ResponsePress press{ResponsePress::Key::next, *next_press_};
    next_press_ = *next_press_ + pressed_again_after;
    return press;
}

} // namespace overt
