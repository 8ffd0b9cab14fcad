/// An eye tracker in real time: a driver whose samples a thread of its own takes, so that the thread that
/// presents never waits for a device.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "devices/tracker/sample_rate_watch.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/base/spsc_ring.h"
#include "experiment/ports/clock.h"

namespace overt {

/// While it records, the device's thread reads the driver, sends marks, and reads both clocks about once a
/// second where the driver can. When the session's thread does not poll for longer than the ring holds, a gap
/// says how many samples were lost.
class ThreadedTracker final : public EyeTracker {
  public:
    /// Connects. `clock` must outlive this. Throws as TrackerDriver::connect(). `ring_capacity`: items; the
    /// default holds eight seconds of both eyes at 2000 Hz with details.
    ThreadedTracker(std::unique_ptr<TrackerDriver> driver, Clock& clock, const TrackerWish& wish,
                    std::size_t ring_capacity = std::size_t{1} << 16);
    ~ThreadedTracker() override;

    TrackerDescription description() const override { return description_; }
    bool tells_events() const noexcept override { return driver_->tells_events(); }
    bool calibrates_itself() const noexcept override { return driver_->calibrates_itself(); }
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    /// Where the driver has no check of its own: median of the first 100 ms within 2 s in which gaze of each
    /// measured eye stayed within 1 degree.
    DriftOutcome drift_check(ScreenPoint target) override;
    std::optional<ClockPair> read_clocks() noexcept override;
    void start_recording() override;
    void stop_recording() override;
    std::size_t poll(std::span<TrackerItem> into) noexcept override;
    bool tell_samples_to(SampleListener* listener) override;
    RecordingState recording_state() const noexcept override {
        return state_.load(std::memory_order_acquire);
    }
    void reconnect() override;
    void mark(const TrackerMark& mark) noexcept override;
    void belongs_in(const std::string& folder) noexcept override { driver_->belongs_in(folder); }
    std::vector<std::string> finish(const std::string& folder, const FileProgress& progress) override;

  private:
    struct HeldMark {
        SessionTime at;
        std::array<char, longest_mark> text;
        std::uint8_t length;
    };
    class RingSink;
    void record(const std::stop_token& stop) noexcept;
    void send_marks() noexcept;

    std::unique_ptr<TrackerDriver> driver_;
    Clock* clock_;
    TrackerWish wish_;
    TrackerDescription description_;
    SpscRing<TrackerItem> items_;
    SpscRing<HeldMark> marks_;
    std::atomic<RecordingState> state_{RecordingState::running};
    std::atomic<std::int64_t> lost_marks_{0};
    SampleListener* listener_ = nullptr;
    SampleRateWatch rate_; ///< the thread's while it records
    std::jthread thread_;  ///< while it records
};

} // namespace overt
