/// The records of one session with several eye trackers, as one.
#pragma once

#include <vector>

#include "experiment/ports/session_log.h"

namespace overt {

/// Each tracker's record is that of a whole session: what was shown, asked and answered goes into all of
/// them. What is the first tracker's own (samples, clock readings, calibrations), and the sound files of
/// answers, goes into the first alone; other trackers' go into their own records directly. Throws as they do.
class SharedLog final : public SessionLog {
  public:
    /// All of them must outlive this.
    explicit SharedLog(SessionLog& first) : first_(first) {}
    void add(SessionLog& further) { further_.push_back(&further); }

    void flip(const FlipRecord& flip) noexcept override {
        in_each([&](SessionLog& log) { log.flip(flip); });
    }
    void slot_flip(const SlotFlip& flip) noexcept override {
        in_each([&](SessionLog& log) { log.slot_flip(flip); });
    }
    void steered_flip(const SteeredFlip& flip) noexcept override {
        in_each([&](SessionLog& log) { log.steered_flip(flip); });
    }
    void missed(const MissedRefresh& refresh) noexcept override {
        in_each([&](SessionLog& log) { log.missed(refresh); });
    }
    void sample(int trial, const GazeSample& sample) noexcept override { first_.sample(trial, sample); }
    void tracker_item(int trial, const TrackerItem& item) noexcept override {
        first_.tracker_item(trial, item);
    }
    void clock_pair(const ClockPair& pair) noexcept override { first_.clock_pair(pair); }
    void calibration(const RecordedCalibration& calibration) override { first_.calibration(calibration); }
    void answer_recorded(const RecordedAnswer& answer) override { first_.answer_recorded(answer); }
    void event(const SessionEvent& event) override {
        in_each([&](SessionLog& log) { log.event(event); });
    }
    void observer_fields(const std::vector<RecordedObserverField>& fields) override {
        in_each([&](SessionLog& log) { log.observer_fields(fields); });
    }
    void consent(const RecordedConsent& consent) override {
        in_each([&](SessionLog& log) { log.consent(consent); });
    }
    void buttons(const std::vector<RecordedButton>& buttons) override {
        in_each([&](SessionLog& log) { log.buttons(buttons); });
    }
    void key_presses(const std::vector<RecordedKeyPress>& presses) override {
        in_each([&](SessionLog& log) { log.key_presses(presses); });
    }
    void gaze_came(const GazeYield& gaze) override { first_.gaze_came(gaze); }
    void markers(const std::vector<RecordedMarker>& markers) override {
        in_each([&](SessionLog& log) { log.markers(markers); });
    }
    void trial_started(const Trial& trial, SessionTime at) override {
        in_each([&](SessionLog& log) { log.trial_started(trial, at); });
    }
    void trial_finished(const Trial& trial, const TrialOutcome& outcome) override {
        in_each([&](SessionLog& log) { log.trial_finished(trial, outcome); });
    }

  private:
    /// The first comes last: what it holds after a power failure, the others hold as well.
    template <class Write> void in_each(Write write) {
        for (SessionLog* log : further_)
            write(*log);
        write(first_);
    }

    SessionLog& first_;
    std::vector<SessionLog*> further_;
};

} // namespace overt
