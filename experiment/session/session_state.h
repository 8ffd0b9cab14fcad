/// What all parts of a session work on: its ports, its trackers and records, its phase, and whether it is
/// over.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_phase.h"
#include "experiment/protocol/protocol.h"
#include "experiment/session/practice_log.h"
#include "experiment/session/session_markers.h"
#include "experiment/session/session_ports.h"
#include "experiment/session/shared_log.h"

namespace overt {

/// One of the eye trackers of a session, and its record.
struct UsedTracker {
    UsedTracker(std::string called, EyeTracker& of, SessionLog& into)
        : id(std::move(called)), tracker(of), record(into), practice(into) {}
    std::string id; ///< empty: the session's own
    EyeTracker& tracker;
    SessionLog& record;
    PracticeLog practice;
    bool is_lost = false;     ///< in a trial, which the record says; the operator was not asked yet
    std::string why_lost;     ///< by then, as far as it is known
    bool is_left_out = false; ///< a further one that the operator gave up, until it is calibrated again

    bool is_further() const { return !id.empty(); }
};

class SessionState {
  public:
    /// Both must outlive this.
    SessionState(const Protocol& of, SessionPorts& on);
    SessionState(const SessionState&) = delete;
    SessionState& operator=(const SessionState&) = delete;

    const Protocol& protocol;
    SessionPorts& ports;
    SessionMarkers markers;

    SessionTime now() const noexcept { return ports.clock.now(); }

    /// All records at once.
    SessionLog& record() { return record_; }
    /// The same; in practice, it keeps events only.
    SessionLog& log() { return is_practice_ ? static_cast<SessionLog&>(practice_) : record_; }
    void set_practice(bool is_practice) { is_practice_ = is_practice; }

    /// The session's own comes first.
    std::deque<UsedTracker>& trackers() { return trackers_; }
    UsedTracker& own_tracker() { return trackers_.front(); }
    /// The tracker's record alone; in practice, it keeps events only.
    SessionLog& log_of(UsedTracker& used) const {
        return is_practice_ ? static_cast<SessionLog&>(used.practice) : used.record;
    }

    SessionPhase phase() const noexcept { return phase_; }
    int trial() const noexcept { return trial_; } ///< -1 outside of trials
    /// Notes the change, and tells the panel. `trial` is kept until the next change.
    void enter(SessionPhase phase, int trial = -1);

    /// An event now, of the trial that is running.
    void note(std::string_view kind, std::string detail = {});
    /// The same of one tracker, in its own record. Of a further one the session's record knows as well.
    void note_of(UsedTracker& used, std::string_view kind, const std::string& detail = {});

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
    std::deque<UsedTracker> trackers_;
    SharedLog record_;
    PracticeLog practice_;
    bool is_practice_ = false;
    SessionPhase phase_ = SessionPhase::set_up;
    int trial_ = -1;
    bool is_over_ = false;
    std::string why_over_;
};

} // namespace overt
