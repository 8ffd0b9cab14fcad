/// A session's log that also tells the operator's view what goes into it.
#pragma once

#include <optional>
#include <vector>

#include "devices/operator/operator_panel.h"
#include "devices/operator/operator_server.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/sample_listener.h"
#include "experiment/ports/session_log.h"

namespace overt {

/// Passes everything on to `record` first, unchanged.
class WatchedLog final : public SessionLog {
  public:
    /// All of it must outlive this.
    /// `gaze`: whom samples are told; null if the tracker does that.
    WatchedLog(SessionLog& record, OperatorServer& server, OperatorPanel& panel, const Clock& clock,
               SampleListener* gaze)
        : record_(record), server_(server), panel_(panel), clock_(clock), gaze_(gaze) {}

    void flip(const FlipRecord& flip) noexcept override;
    void slot_flip(const SlotFlip& flip) noexcept override;
    void steered_flip(const SteeredFlip& flip) noexcept override { record_.steered_flip(flip); }
    void missed(const MissedRefresh& refresh) noexcept override;
    void sample(int trial, const GazeSample& sample) noexcept override;
    void tracker_item(int trial, const TrackerItem& item) noexcept override {
        record_.tracker_item(trial, item);
    }
    void clock_pair(const ClockPair& pair) noexcept override { record_.clock_pair(pair); }
    void event(const SessionEvent& event) override;
    void calibration(const RecordedCalibration& calibration) override;
    void observer_fields(const std::vector<RecordedObserverField>& fields) override {
        record_.observer_fields(fields);
    }
    void consent(const RecordedConsent& consent) override { record_.consent(consent); }
    void buttons(const std::vector<RecordedButton>& buttons) override { record_.buttons(buttons); }
    void key_presses(const std::vector<RecordedKeyPress>& presses) override { record_.key_presses(presses); }
    void gaze_came(const GazeYield& gaze) override { record_.gaze_came(gaze); }
    void markers(const std::vector<RecordedMarker>& markers) override { record_.markers(markers); }
    void answer_recorded(const RecordedAnswer& answer) override { record_.answer_recorded(answer); }
    void trial_started(const Trial& trial, SessionTime at) override;
    void trial_finished(const Trial& trial, const TrialOutcome& outcome) override;

    /// What the log is not told.
    void entered(SessionPhase phase, int trial) noexcept;
    void level(const AudioLevel& level) noexcept;

  private:
    /// With the counts so far.
    void tell(ViewNews news) const noexcept;
    void tell_frame(int trial, int place, AnimationFrameIndex shown, PoseIndex pose, int refresh) noexcept;

    SessionLog& record_;
    OperatorServer& server_;
    OperatorPanel& panel_;
    const Clock& clock_;
    std::int64_t samples_ = 0, lost_ = 0, samples_in_trial_ = 0, lost_in_trial_ = 0;
    std::int64_t missed_ = 0, missed_in_trial_ = 0;
    SampleListener* gaze_;
    std::optional<TrackerTime> told_samples_;
    std::vector<int> told_frames_; ///< by what the trial shows; -1: that nothing is lit
    SessionTime last_blank_;       ///< of the flip that further slots' flips belong to
    std::optional<SessionTime> told_level_;
};

} // namespace overt
