/// One period of a trial's animation shown as in a session, with its tracker, maps and record, before the
/// first trial: what a refresh costs here and now.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/session_log.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// An eye tracker that is tried, and the log of what it alone delivers.
struct CheckedTracker {
    EyeTracker& tracker;
    SessionLog& log;
};

/// All of them as the session has them, but for the log: what is tried is not to be in its record.
struct PresentationCheckPorts {
    Clock& clock;
    Presenter& presenter;
    SessionLog& log; ///< of all trackers, see SharedLog
    std::span<PresentationListener* const> listeners;
    std::span<const CheckedTracker> trackers; ///< the session's own first
    bool has_proven_times = true;             ///< see SessionPorts
};

struct PresentationCheck {
    int refreshes = 0; ///< that got their picture
    int missed = 0;
    bool has_proven_times = true;               ///< else `missed` is told by times that nothing proves
    std::int64_t samples = 0;                   ///< of all trackers, meanwhile
    std::vector<double> intervals_ms;           ///< from each vertical blank with a picture to the next such
    std::vector<double> work_ms;                ///< from asking for each picture to handing over its swap
    std::optional<std::string> tracker_refusal; ///< why a tracker did not record; nothing if all did
};

/// Shows one period of the trial's stimulus, or the whole presentation if that is shorter, on a veiled
/// screen: the observer sees a dark one. Ends early if the presenter closes. On the session's thread, before
/// its first trial. Throws as Presenter::load_frames() and the log do.
PresentationCheck check_presentation(const Protocol& protocol, const Trial& trial,
                                     const PresentationCheckPorts& ports);

/// "240 refreshes, 0 missed, 4012 samples of gaze".
std::string counts_of(const PresentationCheck& check);

/// For the record: the counts, and quantiles of both distributions in ms.
std::string describe(const PresentationCheck& check);

/// More than 1 % of its refreshes were missed: a presentation would miss as many.
bool misses_too_many(const PresentationCheck& check);

} // namespace overt
