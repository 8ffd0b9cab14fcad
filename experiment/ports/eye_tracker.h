/// The port of an eye tracker: what a session asks of it, whichever it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/clock_pair.h"
#include "experiment/ports/sample_listener.h"
#include "experiment/ports/setup_screen.h"
#include "experiment/ports/tracker_items.h"
#include "experiment/ports/validation.h"

namespace overt {

/// What a tracker turned out to be, and what it granted of what was wished.
struct TrackerDescription {
    std::string name;
    double sample_rate_hz = 0.0;
    Eye eye = Eye::right;   ///< the one that is measured; of both, the one that the analysis takes
    bool both_eyes = false; ///< each measurement is two samples of the same time, the left eye's first
    std::string model = {}; ///< as the device tells it: product, version, serial number
    /// What the tracker says of its rate, where that was not taken on trust and sample_rate_hz was measured;
    /// 0: it says nothing, or sample_rate_hz is what it granted.
    double told_rate_hz = 0.0;
};

/// What the tracker, or its operator at the host, says of the recording under way.
enum class RecordingState : std::uint8_t {
    running,
    repeat, ///< the trial, at once
    skip,   ///< the trial: it does not come again
    abort,  ///< the session
    lost    ///< the tracker or the way to it
};

/// How a set-up ended.
struct SetupOutcome {
    enum class Kind : std::uint8_t {
        done,
        cancelled, ///< by the operator, or the display was closed
        failed     ///< no calibration was reached; see `message`
    };
    Kind kind = Kind::done;
    std::optional<ValidationResult> validation; ///< nothing: the tracker does not tell
    std::string method = {};  ///< by which gaze was calibrated, such as "tracker" or "polynomial, 9 points"
    std::string message = {}; ///< what is to be known of it
};

/// How a check of drift ended.
struct DriftOutcome {
    enum class Kind : std::uint8_t { measured, no_eye, set_up_wanted };
    Kind kind = Kind::no_eye;
    Degrees error{}; ///< between gaze and target, where it was measured
};

/// A message for the tracker's own data.
struct TrackerMark {
    SessionTime at;        ///< when what it marks happened, such as a vertical blank
    std::string_view text; ///< ASCII; what exceeds longest_mark bytes is cut; copied before the call returns
};
inline constexpr std::size_t longest_mark = 120; ///< an EyeLink keeps 130 at least

/// On the session's thread. What is noexcept is called between a presentation's first and last flip as well,
/// and allocates, opens and waits for nothing.
class EyeTracker {
  public:
    virtual ~EyeTracker() = default;
    virtual TrackerDescription description() const = 0;

    /// Whether there is a tracker at all. Without one a session does not calibrate, check drift or read the
    /// tracker's clock.
    virtual bool measures_gaze() const noexcept { return true; }

    /// Whether it finds fixations, saccades and blinks itself and delivers them.
    virtual bool tells_events() const noexcept { return false; }

    /// Whether set_up() calibrates; else the program does it, from samples.
    virtual bool calibrates_itself() const noexcept { return true; }

    /// Calibrates and validates, on the set-up screen. Throws DeviceError if the tracker is lost.
    virtual SetupOutcome set_up(SetupScreen& setup_screen) = 0;

    /// Compares gaze with a target that is shown now, within the tracker's own time limit. Throws DeviceError
    /// if the tracker is lost.
    virtual DriftOutcome drift_check(ScreenPoint target) = 0;

    /// Reads both clocks at once, as tightly as the link allows; nothing if there is no way to ask.
    virtual std::optional<ClockPair> read_clocks() noexcept = 0;

    /// Throws DeviceError if the tracker does not begin, or is lost.
    virtual void start_recording() = 0;
    virtual void stop_recording() = 0;

    /// Takes what has arrived, oldest first; gives the number of items. Call until it gives less than the
    /// span holds.
    virtual std::size_t poll(std::span<TrackerItem> into) noexcept = 0;

    /// From the next recording on, each sample is told to `listener` as well, as soon as it comes; null: to
    /// nobody. It must outlive the recordings. False: nothing is known before poll(). Not while it records.
    virtual bool tell_samples_to(SampleListener* /*listener*/) { return false; }

    /// Of the recording under way; `running` outside of recordings while all is well.
    virtual RecordingState recording_state() const noexcept { return RecordingState::running; }
    bool lost() const noexcept { return recording_state() == RecordingState::lost; }

    /// Tries to reach a tracker again that was lost; it must then be set up anew. Throws DeviceError if it
    /// cannot be had.
    virtual void reconnect() {}

    /// Puts a message into the tracker's own data, where it has any.
    virtual void mark(const TrackerMark& /*mark*/) noexcept {}

    /// Into which folder finish() will be asked to fetch the tracker's own file, which a tracker with one
    /// puts down now: a program that crashes or is killed then leaves word of it. Between recordings. Throws
    /// nothing.
    virtual void belongs_in(const std::string& /*folder*/) noexcept {}

    /// Told how much of the host's file has come, in bytes; `total` is 0 while it is not known.
    using FileProgress = std::function<void(std::int64_t done, std::int64_t total)>;
    /// Ends the tracker's session, also after an abort: closes its file and fetches it into `folder`, where
    /// the tracker has one. Gives a sentence for each thing the operator should know; throws nothing.
    virtual std::vector<std::string> finish(const std::string& /*folder*/, const FileProgress& /*progress*/) {
        return {};
    }
};

} // namespace overt
