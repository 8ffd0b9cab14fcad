/// An eye tracker that presents itself as a HID device of usage page 0x12, Eye and Head Trackers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/hid/hid_gaze.h"
#include "devices/hid/hid_line.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

/// The system's HID devices; tests put others in their place.
struct HidSystem {
    std::function<std::vector<HidDeviceInfo>()> devices = hid_devices;
    std::function<std::vector<std::byte>(const std::string& path)> descriptor = [](const std::string& path) {
        return hid_descriptor_of(path);
    };
    std::function<std::unique_ptr<HidLine>(const std::string& path, const Clock&)> open = open_hid;
};

struct HidTrackerSettings {
    /// "/dev/hidraw0", or vendor and product as "1209:0e7e"; empty: the first that is an eye tracker.
    std::string device;
    /// Longest time from a measurement to its arrival, by which the tracker's clock is bounded: the interface
    /// has no question for it.
    SessionDuration longest_delay = std::chrono::milliseconds(50);
};

/// Gaze is one point, of whichever eyes the device measures; it is recorded as the wished eye's, with that
/// eye's place where the device tells it. No report is no gaze. Unplugged is lost.
class HidDriver final : public TrackerDriver {
  public:
    /// `clock` must go by itself and outlive this.
    HidDriver(HidTrackerSettings settings, Clock& clock, HidSystem system = {});

    /// Takes the rate and the size of the screen that the device tells, else the wished. Throws DeviceError
    /// also for a device that is not ready.
    TrackerDescription connect(const TrackerWish& wish) override;
    void start() override;
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;

  private:
    HidDeviceInfo find() const;
    void wait_until_ready(const HidDescriptor& descriptor);
    std::vector<std::byte> feature(const HidDescriptor& descriptor, std::uint8_t report_id);
    void deliver(const HidGazeReport& report, SessionTime arrived, TrackerItemSink& sink) noexcept;

    HidTrackerSettings settings_;
    Clock* clock_;
    HidSystem system_;
    std::unique_ptr<HidLine> line_;
    std::optional<HidGazeLayout> layout_;
    std::vector<std::byte> report_;
    glm::dvec2 px_per_mm_{1.0};
    Eye eye_ = Eye::right;
    double rate_hz_ = 0.0; ///< that the device tells; 0: it does not
    SessionTime bound_due_;
};

/// Whether one of its collections is an eye tracker's.
bool is_eye_tracker(const HidDeviceInfo& device);

/// "1209:0e7e" as numbers; nothing for another text.
std::optional<std::pair<std::uint16_t, std::uint16_t>> hid_numbers(std::string_view text);

} // namespace overt
