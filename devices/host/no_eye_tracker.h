/// No eye tracker: for sessions that only show stimuli and record answers.
#pragma once

#include "experiment/ports/eye_tracker.h"

namespace overt {

/// Gives no samples and is never lost. Its clock is never read: it has none.
class NoEyeTracker final : public EyeTracker {
  public:
    explicit NoEyeTracker(Eye eye) : eye_(eye) {}

    TrackerDescription description() const override { return {"none", 0.0, eye_}; }
    bool measures_gaze() const noexcept override { return false; }
    ValidationResult calibrate() override { return {}; }
    std::optional<Degrees> drift_check(ScreenPoint) override { return std::nullopt; }
    ClockPair read_clocks() noexcept override { return {}; }
    void start_recording() override {}
    void stop_recording() override {}
    std::size_t poll(std::span<GazeSample>) noexcept override { return 0; }
    bool lost() const noexcept override { return false; }

  private:
    Eye eye_; ///< for the session's header, which always names one
};

} // namespace overt
