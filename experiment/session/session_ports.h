/// Everything that a session talks to.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/ports/answer_recorder.h"
#include "experiment/ports/area_view.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/marker_sink.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/probe_view.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_log.h"
#include "experiment/ports/session_phase.h"
#include "experiment/ports/setup_screen.h"

namespace overt {

/// An eye tracker that records beside the session's own.
struct FurtherTracker {
    std::string id; ///< as [[further_tracker]] has it
    EyeTracker& tracker;
    SessionLog& log; ///< a record of its own: it gets what was shown and answered as well, see SharedLog
};

/// All of it must outlive the session.
struct SessionPorts {
    Clock& clock;
    Presenter& presenter;
    EyeTracker& tracker;
    ResponsePanel& panel;
    SessionLog& log;
    std::vector<PresentationListener*> listeners;
    std::string observer = {};          ///< label, for the record of consent
    bool can_type = false;              ///< somebody sits at the panel's keyboard and can fill in the form
    AnswerRecorder* recorder = nullptr; ///< null: spoken answers are not recorded
    /// Told every now and then while an answer is recorded, between presentations; may be empty.
    std::function<void(const AudioLevel&)> on_level = {};
    /// One for each [[marker_output]] of the protocol, in their order; null for one that rides on the video
    /// signal, or is left out. None at all: no marker is sent.
    std::vector<MarkerSink*> markers = {};
    /// They are set up and record with the session's own tracker, by which alone trials are judged.
    std::vector<FurtherTracker> further_trackers = {};
    /// Sounds while the tracker is set up; may be empty.
    std::function<void(Beep)> on_beep = {};
    /// Told of each image of the tracker's camera that is shown; may be empty.
    std::function<void(const CameraImage&)> on_camera = {};
    /// Gives an area of the object that a stimulus shows in its slot, that gaze is waited for; between
    /// presentations. Empty, or null given: gaze is never there.
    std::function<std::shared_ptr<const AreaView>(const PlacedStimulus&, const std::string& area)> area_of =
        {};
    /// Gives a place of the object that a stimulus shows in its slot, by its name; between presentations.
    /// Empty, or null given: nobody knows where it is.
    std::function<std::shared_ptr<const ProbeView>(const PlacedStimulus&, const std::string& point)>
        probe_of = {};
    /// Told of each change of phase, with the trial or -1; not during a presentation. May be empty.
    std::function<void(SessionPhase, int)> on_phase = {};
    /// Gives what of the screen has changed since it was asked last so that what is shown may not be what the
    /// protocol says, a sentence each. Asked between trials only: it may wait for a server. May be empty.
    std::function<std::vector<std::string>()> screen_changes = {};
    /// Refreshes are told by a real display's vertical blanks; else no number of missed ones is given out.
    bool has_proven_times = true;
};

} // namespace overt
