#include "experiment/session/session_state.h"

#include "experiment/base/error.h"

namespace overt {

void SessionState::enter(SessionPhase phase, int trial) {
    OVERT_EXPECTS(may_follow(phase_, phase));
    phase_ = phase;
    trial_ = trial;
    ports.panel.entered(phase, trial);
    if (ports.on_phase)
        ports.on_phase(phase, trial);
    note(phase_event, std::string(name_of(phase)));
}

void SessionState::note(std::string_view kind, std::string detail) {
    log_->event({now(), trial_, kind, std::move(detail)});
}

SessionTime SessionState::show(const Screen& screen) {
    const SessionTime onset = ports.presenter.show(screen).vertical_blank;
    for (PresentationListener* listener : ports.listeners)
        listener->screen_shown(screen, onset);
    return onset;
}

void SessionState::end_session(std::string why) {
    if (!is_over_)
        why_over_ = std::move(why);
    is_over_ = true;
}

bool SessionState::ends_by_itself() {
    if (!went_away())
        return false;
    end_session(ports.presenter.why_closed());
    return true;
}

} // namespace overt
