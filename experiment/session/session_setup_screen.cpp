#include "experiment/session/session_setup_screen.h"

#include <algorithm>

#include "experiment/session/operator_control.h"

namespace overt {

SessionSetupScreen::SessionSetupScreen(SessionState& state)
    : state_(state), geometry_(screen_geometry_of(state.protocol)) {
    state_.ports.panel.await_setup(state_.now());
}

SessionTime SessionSetupScreen::show_target(ScreenPoint place, Degrees diameter) {
    return state_.show(
        {.kind = Screen::Kind::target, .text = "", .target_place = place, .target_diameter = diameter});
}

SessionTime SessionSetupScreen::clear() { return state_.show({}); }

void SessionSetupScreen::show_camera(const CameraImage& image) {
    if (state_.ports.on_camera)
        state_.ports.on_camera(image);
    state_.show({.kind = Screen::Kind::camera,
                 .text = image.title,
                 .frame = state_.protocol.words.experimenter,
                 .camera = image});
}

void SessionSetupScreen::show_text(const std::string& text) {
    state_.show({.kind = Screen::Kind::text, .text = text, .frame = state_.protocol.words.experimenter});
}

void SessionSetupScreen::show_result(const ValidationResult& result, const std::string& text) {
    state_.show({.kind = Screen::Kind::validation,
                 .text = text,
                 .frame = state_.protocol.words.experimenter,
                 .validated = result.targets});
}

void SessionSetupScreen::beep(Beep beep) {
    if (state_.ports.on_beep)
        state_.ports.on_beep(beep);
}

void SessionSetupScreen::wait(SessionDuration time) {
    const SessionTime until = state_.now() + time;
    while (state_.now() < until && !state_.went_away()) {
        state_.ports.presenter.use_spare_time();
        state_.ports.clock.wait_until(std::min(until, state_.now() + key_interval));
    }
}

} // namespace overt
