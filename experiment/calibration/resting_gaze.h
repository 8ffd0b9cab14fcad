/// When gaze rests in one place, and where: what a calibration, a validation and a check of drift stand on.
#pragma once

#include <deque>
#include <optional>

#include "experiment/gaze.h"
#include "experiment/screen_geometry.h"
#include "experiment/units.h"

namespace overt {

/// Gaze of one eye that rested: the median of its samples within reach, and how those of the window's second
/// half scatter, when the last saccade has died away.
struct RestedGaze {
    ScreenPoint median;
    Degrees rms_s2s{}; ///< root mean square of the angles between successive samples
    Degrees sd{};      ///< root of the summed variances of both axes
    int samples = 0;   ///< with gaze
};

/// Looks at the last samples of one eye. An eye rests while, over the whole window, gaze was there in at
/// least four of five samples and all but one in fifty of these lay within `reach` of their median. Degrees
/// by the scale at the screen's middle, for uncalibrated gaze has no better.
class RestingGaze {
  public:
    struct Settings {
        TrackerClock::duration window = std::chrono::milliseconds(100);
        Degrees reach{0.5};
    };
    RestingGaze(const ScreenGeometry& screen, const Settings& settings);

    /// Samples of one eye, in the order of their times.
    void take(const GazeSample& sample);
    void forget() { samples_.clear(); }
    /// Nothing while it does not rest, or while less than the window has passed.
    std::optional<RestedGaze> rested() const;

  private:
    Settings settings_;
    double px_per_deg_;
    std::deque<GazeSample> samples_;
};

} // namespace overt
