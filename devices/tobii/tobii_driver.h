/// Eye trackers of Tobii below a screen, through the maker's library.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/tobii/tobii_inbox.h"
#include "devices/tobii/tobii_library.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

struct TobiiSettings {
    std::string library; ///< its file; empty: see load_tobii()
    /// The tracker's address, such as "tet-tcp://172.28.195.1", or its serial number; empty: the only one.
    std::string device = {};
    std::vector<ScreenPoint> calibration_points = {}; ///< on the screen, in px; in this order
    Degrees target{0.5};
    /// How long a target is there before it is measured.
    SessionDuration target_delay = std::chrono::milliseconds(1000);
    /// Of a call that measures at a target or computes, which the library says take 10 s at most.
    SessionDuration calibration_patience = std::chrono::seconds(30);
    /// Of a recording in which nothing comes: the tracker is lost. It tells of eyes that it does not find,
    /// too.
    SessionDuration silence = std::chrono::seconds(2);
    /// From a measurement to its arrival: how far the tracker's clock is known while the library has not
    /// asked for its time yet (inferred).
    SessionDuration longest_delay = std::chrono::milliseconds(50);
};

/// Samples carry the pupil's diameter in mm and the eye's place from the tracker. Both eyes are measured at
/// once; of one wished eye the other's samples are left out. A change of the input port is an input. Missing
/// measurements are told from the tracker's times, since it does not count.
class TobiiDriver final : public TrackerDriver {
  public:
    /// `clock` must go by the machine's time, as the library's does, and outlive the driver.
    TobiiDriver(TobiiSettings settings, Clock& clock);
    ~TobiiDriver() override;

    TrackerDescription connect(const TrackerWish& wish) override;
    bool calibrates_itself() const noexcept override { return true; }
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    void start() override;
    void stop() noexcept override;
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    std::optional<ClockPair> read_clocks() noexcept override;
    std::vector<std::string> finish(const std::string& folder,
                                    const EyeTracker::FileProgress& progress) override;

  private:
    void disconnect() noexcept;
    TobiiEyeTracker* find_tracker() const;
    std::int32_t capabilities() const;
    void require_screen() const;
    double choose_rate() const;
    double rate() const;
    void deliver(const TobiiMeasurement& measured, TrackerItemSink& sink) noexcept;
    void deliver(const TobiiPort& port, TrackerItemSink& sink) noexcept;
    bool deliver_news(TrackerItemSink& sink) noexcept;

    TobiiSettings settings_;
    Clock& clock_;
    std::shared_ptr<const TobiiLibrary> library_;
    std::unique_ptr<TobiiInbox> inbox_;
    TobiiEyeTracker* tracker_ = nullptr;
    TrackerWish wish_;
    TrackerDescription description_;
    bool has_been_asked_for_time_ = false;
    SessionTime last_arrival_, bound_due_;
    std::int64_t last_us_ = 0;   ///< of the recording's last measurement; 0: there was none
    bool is_clock_back_ = false; ///< times are earlier than that
    std::optional<std::uint32_t> port_;
};

/// Trackers that the library finds, in words. Throws DeviceError if there is no library.
std::string tobii_trackers_found();

} // namespace overt
