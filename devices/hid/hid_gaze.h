/// Gaze in the reports of a HID eye tracker: usage page 0x12, Eye and Head Trackers, of the HID Usage Tables
/// (request HUTRR74). Where what stands is taken from the descriptor; devices leave parts out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "devices/hid/report_descriptor.h"
#include "experiment/session_time.h"

namespace overt {

/// How ready a tracker says that it is.
enum class HidTrackerReadiness : std::uint8_t {
    unknown = 0,
    ready = 1,
    configuring = 2,
    screen_setup_needed = 3,
    user_calibration_needed = 4
};

/// One report of tracking data. Absent: the device does not have it or says that it has none now.
struct HidGazeReport {
    std::optional<TrackerTime> at;     ///< of its own clock, in microseconds
    std::optional<glm::dvec2> gaze_mm; ///< on the screen: from its top left corner, x to the right, y down
    std::optional<glm::vec3> left_mm, right_mm; ///< where the eyes are, in the tracker's coordinates
};

/// The parts of a device's reports that a session needs.
class HidGazeLayout {
  public:
    /// Nothing if the descriptor has no eye tracker's data with a gaze point in units of length; `why` then
    /// says what is lacking.
    static std::optional<HidGazeLayout> find(const HidDescriptor& descriptor, std::string& why);

    /// Nothing for a report of another kind or one that is cut off before the gaze point.
    std::optional<HidGazeReport> read(std::span<const std::byte> report) const noexcept;

    // Feature reports; 0: the device has none, else the report's id. A device without ids has none to tell
    // them apart by, and then they are not used.
    std::uint8_t status_report() const noexcept {
        return readiness_ ? readiness_->report_id : frequency_report();
    }
    std::uint8_t configuration_report() const noexcept {
        return screen_width_ ? screen_width_->report_id : std::uint8_t{0};
    }
    std::uint8_t control_report() const noexcept { return mode_ ? mode_->report_id : std::uint8_t{0}; }

    HidTrackerReadiness readiness(std::span<const std::byte> status) const noexcept;
    std::optional<double> sampling_hz(std::span<const std::byte> status) const noexcept;
    /// Of the screen that it was calibrated for, in millimetres.
    std::optional<glm::dvec2> screen_mm(std::span<const std::byte> configuration) const noexcept;
    /// Asks for gaze and the eyes' places; `control` is a report of the right length with its id.
    void request_gaze(std::span<std::byte> control) const noexcept;

    bool tells_time() const noexcept { return !time_.empty(); }

  private:
    std::uint8_t frequency_report() const noexcept {
        return frequency_ ? frequency_->report_id : std::uint8_t{0};
    }

    using Place = std::array<std::optional<HidField>, 3>;
    std::uint8_t report_id_ = 0;
    bool has_ids_ = false;
    std::vector<HidField> time_; ///< one field, or eight of one byte, the lowest first
    double time_unit_us_ = 1.0;
    Place gaze_, left_, right_;
    std::optional<HidField> readiness_, frequency_, screen_width_, screen_height_, mode_;
};

} // namespace overt
