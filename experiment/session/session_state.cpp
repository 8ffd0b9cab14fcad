#include "experiment/session/session_state.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

SessionState::SessionState(const Protocol& of, SessionPorts& on)
    : protocol(of), ports(on), markers(of, on.markers), record_(on.log), practice_(record_) {
    trackers_.emplace_back(std::string(), on.tracker, on.log);
    for (const FurtherTracker& further : on.further_trackers) {
        trackers_.emplace_back(further.id, further.tracker, further.log);
        record_.add(further.log);
    }
}

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
    log().event({now(), trial_, kind, std::move(detail)});
}

void SessionState::note_of(UsedTracker& used, std::string_view kind, const std::string& detail) {
    log_of(used).event({now(), trial_, kind, detail});
    if (used.is_further())
        log_of(own_tracker())
            .event({now(), trial_, further_tracker_event,
                    fmt::format("{}: {}{}{}", used.id, kind, detail.empty() ? "" : ": ", detail)});
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
