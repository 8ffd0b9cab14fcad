/// What an eye tracker says, untouched.
#pragma once

#include <cstdint>
#include <optional>

#include "experiment/session_time.h"
#include "experiment/units.h"

namespace overt {

enum class Eye : std::uint8_t { left, right };

/// One sample of one eye. No gaze when the eye was lost (blink, pupil not found).
struct GazeSample {
    TrackerTime sampled_at;
    Eye eye = Eye::right;
    std::optional<ScreenPoint> gaze;
    float pupil_area = 0.0f; ///< the tracker's own unit; 0 when lost
};

} // namespace overt
