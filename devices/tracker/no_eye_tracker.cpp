/// No eye tracker: for sessions that only show stimuli and record answers.
#include "devices/tracker/tracker_device.h"

namespace overt {
namespace {

/// Gives no samples and is never lost. Its clock is never read: it has none.
class NoEyeTracker final : public EyeTracker {
  public:
    explicit NoEyeTracker(Eye eye) : eye_(eye) {}

    TrackerDescription description() const override { return {"none", 0.0, eye_}; }
    bool measures_gaze() const noexcept override { return false; }
    SetupOutcome set_up(SetupScreen&) override { return {}; }
    DriftOutcome drift_check(ScreenPoint) override { return {}; }
    std::optional<ClockPair> read_clocks() noexcept override { return std::nullopt; }
    void start_recording() override {}
    void stop_recording() override {}
    std::size_t poll(std::span<TrackerItem>) noexcept override { return 0; }

  private:
    Eye eye_; ///< for the session's header, which always names one
};

} // namespace

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("none")>() {
    return {.make_tracker = [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
        return std::make_unique<NoEyeTracker>(parts.protocol.tracker.analysed_eye());
    }};
}

} // namespace overt
