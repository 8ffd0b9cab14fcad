/// The mouse pointer in place of an eye: for trying a protocol at a desk, and for showing what happens.
#pragma once

#include <memory>

#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Asks the X server where its pointer is, at the wished rate up to 1000 Hz, on the clock of this computer.
/// Its places are pixels of the whole X screen: right for a stimulus that begins at its top left corner, as
/// on a monitor of its own. The left button held down is a closed eye. Each button is told, too.
class PointerDriver final : public TrackerDriver {
  public:
    explicit PointerDriver(Clock& clock);
    ~PointerDriver() override;

    /// Throws DeviceError if there is no X server.
    TrackerDescription connect(const TrackerWish& wish) override;
    /// There is nothing to calibrate: the pointer is where it is.
    bool calibrates_itself() const noexcept override { return true; }
    SetupOutcome set_up(SetupScreen&) override {
        return {SetupOutcome::Kind::done, {}, "tracker", "the pointer needs no calibration"};
    }
    void start() override;
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    std::optional<ClockPair> read_clocks() noexcept override;

  private:
    struct XConnection;
    Clock& clock_;
    std::unique_ptr<XConnection> x_;
    std::int64_t interval_ns_ = 1'000'000, next_ = 0; ///< of samples, in intervals of the session clock
    unsigned buttons_ = 0;
    Eye eye_ = Eye::right;
};

} // namespace overt
