/// What a driver of one make of eye tracker does. ThreadedTracker makes an EyeTracker of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/eye_tracker.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// What a session wishes of its tracker; what was granted is in the TrackerDescription.
struct TrackerWish {
    double rate_hz = 1000.0;
    Eye eye = Eye::right; ///< of one eye; of both, the one that the analysis takes
    bool both_eyes = false;
    ScreenGeometry screen = {};
    /// Whom a file on the tracker's host is for: the observer, or the id of a further tracker.
    std::string file_name = "overt";
};

/// Where a driver puts what it reads. Never waits, allocates or throws.
class TrackerItemSink {
  public:
    virtual ~TrackerItemSink() = default;
    virtual void put(const TrackerItem& item) noexcept = 0;
};

/// One thread at a time: read(), send() and what they use run on a device thread between start() and stop(),
/// all else on the session's thread outside of that. Nothing may wait without a time limit: a tracker that
/// does not answer is an error at set-up and RecordingState::lost in a recording.
class TrackerDriver {
  public:
    virtual ~TrackerDriver() = default;

    /// Finds the device, connects and configures it, also again after it was lost. Throws DeviceError if it
    /// is not there or does not do what is needed, InputError for a wish that it cannot have.
    virtual TrackerDescription connect(const TrackerWish& wish) = 0;

    virtual bool tells_events() const noexcept { return false; }

    /// Whether set_up() does anything; else gaze is calibrated by the program where the protocol says so.
    virtual bool calibrates_itself() const noexcept { return false; }
    /// Throws DeviceError if the tracker is lost.
    virtual SetupOutcome set_up(SetupScreen&) { return {}; }

    /// Nothing: the tracker has no check of its own, and drift is measured from its samples.
    virtual std::optional<DriftOutcome> drift_check(ScreenPoint /*target*/) { return std::nullopt; }

    /// Samples are wanted from now on. Throws DeviceError if the tracker does not begin.
    virtual void start() = 0;
    virtual void stop() noexcept = 0;

    /// Takes what has arrived and puts it into the sink, oldest first; waits until the deadline for something
    /// to arrive and returns soon after something did. Gives how the recording is.
    virtual RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept = 0;

    /// Puts a message into the tracker's own data. `mark.at` lies in the past by some milliseconds.
    virtual void send(const TrackerMark& /*mark*/) noexcept {}

    /// A two-way reading of both clocks; nothing if the tracker offers none. May be called on either thread,
    /// never on both at once. A driver without it may put one-way bounds into the stream as ClockPair items:
    /// sampled between `before` = arrival less the longest delay that its data sheet names, and `after` =
    /// arrival.
    virtual std::optional<ClockPair> read_clocks() noexcept { return std::nullopt; }

    /// See EyeTracker::belongs_in(). Outside of start() and stop().
    virtual void belongs_in(const std::string& /*folder*/) noexcept {}

    /// See EyeTracker::finish().
    virtual std::vector<std::string> finish(const std::string& /*folder*/,
                                            const EyeTracker::FileProgress& /*progress*/) {
        return {};
    }
};

} // namespace overt
