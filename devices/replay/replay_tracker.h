/// An eye tracker that plays a recording back.
#pragma once

#include <map>
#include <set>

#include "devices/replay/replay_source.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Each trial has the gaze of the trial with the same number, the n-th attempt that of the n-th. Gaze is
/// aligned at the onset of the presentation, so that it meets the frames that the observer saw; where the
/// recording tells no onset, at the beginning of the recording. Its clock is the recording's. Works in real
/// and in virtual time, by `clock` alone, on the session's thread.
class ReplayTracker final : public EyeTracker {
  public:
    /// `clock` must outlive this. Throws as ReplaySource.
    ReplayTracker(const std::filesystem::path& recording, Clock& clock);

    TrackerDescription description() const override;
    bool tells_events() const noexcept override { return source_.tells_events(); }
    /// The recording's own validations, one after the other.
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    /// What the recording's drift check found in this trial. Takes the tenth of a second that one takes.
    DriftOutcome drift_check(ScreenPoint target) override;
    std::optional<ClockPair> read_clocks() noexcept override;
    void start_recording() override;
    void stop_recording() override;
    std::size_t poll(std::span<TrackerItem> into) noexcept override;
    void mark(const TrackerMark& mark) noexcept override;
    std::vector<std::string> finish(const std::string& folder, const FileProgress& progress) override;

  private:
    void load(); ///< the trial's counterpart, if that was not done yet
    TrackerTime tracker_now() const { return source_.clock().to_other(clock_->now()); }
    void align(TrackerTime recorded, TrackerTime now) noexcept { forward_ = now - recorded; }

    std::filesystem::path recording_path_;
    ReplaySource source_;
    Clock* clock_;
    int set_ups_ = 0;
    std::optional<int> trial_;
    std::map<int, int> attempts_;
    bool is_told_trials_ = false; ///< else it plays the first one, as in a test of trackers
    std::optional<ReplayedTrial> replayed_;
    std::size_t next_ = 0;
    bool recording_ = false;
    std::optional<TrackerClock::duration> forward_; ///< of the items' times; nothing before they are aligned
    std::optional<TrackerTime> end_;                ///< of a recording that was stopped
    std::set<int> missing_, unlike_; ///< trials without a counterpart, or with another stimulus
};

} // namespace overt
