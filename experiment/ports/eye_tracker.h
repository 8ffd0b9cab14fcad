/// The port of an eye tracker.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiment/clock_pair.h"
#include "experiment/gaze.h"
#include "experiment/units.h"

namespace overt {

struct TrackerDescription {
    std::string name;
    double sample_rate_hz = 0.0;
    Eye eye = Eye::right;
};

/// Accuracy reached by a calibration, from its validation.
struct ValidationResult {
    Degrees mean_error;
    Degrees max_error;
};

class EyeTracker {
  public:
    virtual ~EyeTracker() = default;
    virtual TrackerDescription description() const = 0;

    /// Whether there is a tracker at all. Without one a session does not calibrate, check drift or read the
    /// tracker's clock.
    virtual bool measures_gaze() const noexcept { return true; }

    /// Calibrates and validates. Throws DeviceError if the tracker is lost.
    virtual ValidationResult calibrate() = 0;

    /// Measured distance between the gaze and a target that is shown now, or nothing if no eye was found
    /// within the tracker's own time limit.
    virtual std::optional<Degrees> drift_check(ScreenPoint target) = 0;

    /// Reads both clocks at once, as tightly as the link allows.
    virtual ClockPair read_clocks() noexcept = 0;

    virtual void start_recording() = 0;
    virtual void stop_recording() = 0;

    /// Takes samples that have arrived, oldest first; gives their number. Call until it gives less than the
    /// span holds. Allocates and throws nothing.
    virtual std::size_t poll(std::span<GazeSample> into) noexcept = 0;

    virtual bool lost() const noexcept = 0;
};

} // namespace overt
