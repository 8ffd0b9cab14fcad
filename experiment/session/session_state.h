/// What all parts of a session work on: its ports, its phase, and whether it is over.
#pragma once

#include <string>
#include <string_view>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_phase.h"
#include "experiment/protocol/protocol.h"
#include "experiment/session/session_markers.h"
#include "experiment/session/session_ports.h"

namespace overt {

class SessionState {
  public:
    /// Both must outlive this.
    SessionState(const Protocol& of, SessionPorts& on)
        : protocol(of), ports(on), markers(of, on.markers), log_(&on.log) {}

    const Protocol& protocol;
    SessionPorts& ports;
    SessionMarkers markers;

    SessionTime now() const noexcept { return ports.clock.now(); }

    /// The record; in practice, one that keeps events only.
    SessionLog& log() { return *log_; }
    void log_to(SessionLog& log) { log_ = &log; }

    SessionPhase phase() const noexcept { return phase_; }
    int trial() const noexcept { return trial_; } ///< -1 outside of trials
    /// Notes the change, and tells the panel. `trial` is kept until the next change.
    void enter(SessionPhase phase, int trial = -1);

    /// An event now, of the trial that is running.
    void note(std::string_view kind, std::string detail = {});

    /// Records what response boxes and outputs of markers did since. Not during a presentation.
    void write_down() {
        ports.panel.write_down(log());
        markers.write_down(log());
    }

    /// Shows a screen and tells the listeners; gives its onset.
    SessionTime show(const Screen& screen);

    /// The display has gone away.
    bool went_away() const noexcept { return ports.presenter.closed(); }

    /// The session ends after what is under way. The first reason stays.
    void end_session(std::string why);
    bool is_over() const noexcept { return is_over_; }
    const std::string& why_over() const noexcept { return why_over_; }

    /// Ends the session if the display went away; whether it did.
    bool ends_by_itself();

  private:
    SessionLog* log_;
    SessionPhase phase_ = SessionPhase::set_up;
    int trial_ = -1;
    bool is_over_ = false;
    std::string why_over_;
};

} // namespace overt
