#include "experiment/session/session_stage.h"

#include <algorithm>

#include "experiment/session/operator_control.h"

namespace overt {

SessionStage::SessionStage(SessionState& state)
    : state_(state), geometry_(screen_geometry_of(state.protocol)) {
    state_.ports.panel.await_setup(state_.now());
}

SessionTime SessionStage::show_target(ScreenPoint place, Degrees diameter) {
    return state_.show(
        {.kind = Screen::Kind::target, .text = "", .target_place = place, .target_diameter = diameter});
}

SessionTime SessionStage::clear() { return state_.show({}); }

void SessionStage::show_camera(const CameraImage& image) {
    if (state_.ports.on_camera)
        state_.ports.on_camera(image);
    state_.show({.kind = Screen::Kind::camera,
                 .text = image.title,
                 .frame = state_.protocol.words.experimenter,
                 .camera = image});
}

void SessionStage::show_text(const std::string& text) {
    state_.show({.kind = Screen::Kind::text, .text = text, .frame = state_.protocol.words.experimenter});
}

void SessionStage::show_result(const ValidationResult& result, const std::string& text) {
    state_.show({.kind = Screen::Kind::validation,
                 .text = text,
                 .frame = state_.protocol.words.experimenter,
                 .validated = result.targets});
}

void SessionStage::beep(SetupBeep beep) {
    if (state_.ports.on_beep)
        state_.ports.on_beep(beep);
}

void SessionStage::wait(SessionDuration time) {
    const SessionTime until = state_.now() + time;
    while (state_.now() < until && !state_.went_away()) {
        state_.ports.presenter.use_spare_time();
        state_.ports.clock.wait_until(std::min(until, state_.now() + key_interval));
    }
}

} // namespace overt
