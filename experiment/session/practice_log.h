/// The record while practice goes on.
#pragma once

#include "experiment/ports/session_log.h"

namespace overt {

/// Keeps the events of practice, as events outside of trials, and drops its flips and samples: those are
/// recorded of trials only. Throws as the record does.
class PracticeLog final : public SessionLog {
  public:
    /// `record` must outlive this.
    explicit PracticeLog(SessionLog& record) : record_(record) {}
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair& pair) noexcept override { record_.clock_pair(pair); }
    void calibration(const RecordedCalibration& calibration) override {
        RecordedCalibration outside = calibration;
        outside.trial = -1;
        record_.calibration(outside);
    }
    void buttons(const std::vector<RecordedButton>& buttons) override {
        std::vector<RecordedButton> outside = buttons;
        for (RecordedButton& button : outside)
            button.trial = -1;
        record_.buttons(outside);
    }
    void key_presses(const std::vector<RecordedKeyPress>& presses) override {
        std::vector<RecordedKeyPress> outside = presses;
        for (RecordedKeyPress& press : outside)
            press.trial = -1;
        record_.key_presses(outside);
    }
    void markers(const std::vector<RecordedMarker>& markers) override { record_.markers(markers); }
    void event(const SessionEvent& event) override {
        record_.event({event.at, -1, event.kind,
                       event.detail.empty() ? "in practice" : event.detail + ", in practice"});
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}

  private:
    SessionLog& record_;
};

} // namespace overt
