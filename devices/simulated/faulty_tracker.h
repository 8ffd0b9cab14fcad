/// An eye tracker with which goes wrong what a script says, for trial runs.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/tracker_faults.h"

namespace overt {

/// Between a session and a tracker that does not fail by itself. Knows trials as a tracker's host does, by
/// the mark "TRIALID n". On the session's thread, as every EyeTracker.
class FaultyTracker final : public EyeTracker {
  public:
    /// `clock` must outlive this.
    FaultyTracker(std::unique_ptr<EyeTracker> tracker, Clock& clock, TrackerFaults faults);

    /// Silence for longer than this counts as a lost tracker, as it does with an EyeLink.
    static constexpr SessionDuration patience = std::chrono::seconds(1);

    TrackerDescription description() const override { return tracker_->description(); }
    bool measures_gaze() const noexcept override { return tracker_->measures_gaze(); }
    bool tells_events() const noexcept override { return tracker_->tells_events(); }
    bool calibrates_itself() const noexcept override { return tracker_->calibrates_itself(); }
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    DriftOutcome drift_check(ScreenPoint target) override;
    std::optional<ClockPair> read_clocks() noexcept override;
    void start_recording() override;
    void stop_recording() override;
    std::size_t poll(std::span<TrackerItem> into) noexcept override;
    RecordingState recording_state() const noexcept override { return state_; }
    void reconnect() override;
    void mark(const TrackerMark& mark) noexcept override;
    void belongs_in(const std::string& folder) noexcept override { tracker_->belongs_in(folder); }
    std::vector<std::string> finish(const std::string& folder, const FileProgress& progress) override {
        return tracker_->finish(folder, progress);
    }

    /// The faults that happened since this was called last, a sentence each.
    std::vector<std::string> take_struck();

  private:
    struct Striking {
        TrackerFault fault;
        bool has_struck = false;
    };
    bool is_within(const Striking& striking, double elapsed_s) const noexcept;
    void require_connection() const;
    void look_at_stall() noexcept;
    /// Puts what becomes of an item in front of what is read next; false: nothing becomes of it.
    bool pass(TrackerItem& item) noexcept;
    bool pass_sample(GazeSample& sample) noexcept;

    std::unique_ptr<EyeTracker> tracker_;
    Clock* clock_;
    TrackerFaults faults_;
    std::map<int, int> attempts_; ///< at each trial
    int trial_ = -1, set_ups_ = 0;
    std::vector<Striking> now_; ///< those of the recording under way
    RecordingState state_ = RecordingState::running;
    int refusals_ = 0; ///< attempts to connect that will fail
    bool recording_ = false;
    std::optional<TrackerTime> first_;     ///< of the recording's samples, as the tracker tells them
    TrackerTime last_{};                   ///< delivered
    TrackerClock::duration put_forward_{}; ///< its clock, by all jumps
    std::optional<SessionTime> stalled_since_, stalled_until_;
    std::int64_t lost_ = 0; ///< samples withheld that no gap has told of yet
    TrackerGap::Reason lost_by_ = TrackerGap::Reason::overflow;
    std::vector<TrackerItem> read_; ///< from the tracker
    std::size_t next_ = 0, end_ = 0;
    std::vector<TrackerItem> ahead_; ///< to be given first, the last one first; at most three
    std::vector<std::string> struck_;
};

} // namespace overt
