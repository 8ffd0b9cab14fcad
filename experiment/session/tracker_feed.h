/// What one eye tracker delivers while it records, taken into its log.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/session_log.h"
#include "experiment/session/gaze_watch.h"

namespace overt {

/// On the session's thread. What is noexcept allocates and waits for nothing.
class TrackerFeed {
  public:
    /// `tracker` must outlive this.
    explicit TrackerFeed(EyeTracker& tracker);

    /// Forgets the recording before, and begins one, now. False: the tracker is lost, see why_lost().
    bool start_recording(SessionTime now);
    /// Ends it, if it was begun, now. Take what came at last after it.
    void stop_recording(SessionTime now);

    /// Takes what has arrived. A sample that comes a second time is counted and left out. `gaze_watch`: told
    /// of each sample, if it is given.
    void take_items(int trial, SessionLog& log, GazeWatch* gaze_watch = nullptr) noexcept;
    /// Reads both clocks some times over, where there is a tracker.
    void read_clocks(SessionLog& log) noexcept;
    /// Of both clocks since the tracker's jumped last, the newest some thousand.
    std::span<const ClockPair> readings() const noexcept { return readings_; }
    /// Asks for the recording's state; the first that is not `running` stays.
    void look_at_state() noexcept;

    /// Of this recording.
    RecordingState state() const noexcept { return state_; }
    bool has_recorded() const noexcept { return has_recorded_; } ///< it began
    const std::string& why_lost() const noexcept { return why_lost_; }
    std::int64_t sample_count() const noexcept { return yield().samples; }
    std::int64_t doubled_count() const noexcept { return doubled_count_; }
    /// What it has given since it began, until it ended.
    GazeYield yield() const noexcept { return yield_.ended_after(ended_ - began_); }
    /// By how much the tracker's clock jumped since this was asked last; nothing if it did not.
    std::optional<SessionDuration> take_jump() noexcept;

  private:
    void take(int trial, const TrackerItem& item, SessionLog& log, GazeWatch* gaze_watch) noexcept;
    void watch(const ClockPair& pair) noexcept;

    EyeTracker& tracker_;
    std::vector<TrackerItem> items_; ///< room for one poll
    GazeYieldCount yield_;
    SessionTime began_, ended_;
    std::int64_t doubled_count_ = 0;
    std::array<std::optional<TrackerTime>, 2> last_at_; ///< of each eye's samples
    RecordingState state_ = RecordingState::running;
    bool has_recorded_ = false;
    std::string why_lost_;
    // Over all recordings.
    std::vector<ClockPair> readings_;           ///< with room for all that are kept
    std::optional<ClockPair> steady_, suspect_; ///< the last reading on the line, and one that is off it
    std::optional<SessionDuration> jump_;
};

} // namespace overt
