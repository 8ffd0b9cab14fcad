/// How much gaze a recording of an eye tracker gave, of all that it should have given.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "experiment/gaze.h"
#include "experiment/session_time.h"

namespace overt {

/// Samples of all eyes that are measured.
struct GazeYield {
    std::int64_t samples = 0;      ///< that came
    std::int64_t without_gaze = 0; ///< among them: no eye was found
    std::int64_t missing = 0;      ///< that should have come by the tracker's rate, and did not

    /// Share with gaze of all that there should be, 0 … 1; 0 where nothing came.
    double share() const noexcept {
        const std::int64_t all = samples + missing;
        return all > 0 ? static_cast<double>(samples - without_gaze) / static_cast<double>(all) : 0.0;
    }
    bool operator==(const GazeYield&) const = default;
};

/// Counts the samples of one recording. What is missing are the samples of gaps in a tracker's own time that
/// are longer than three of its intervals and a tenth of a second (no tracker's own jitter), and those of all
/// time before the first and after the last sample that goes beyond half a second: trackers need a while to
/// begin, and deliver late. Allocates nothing.
class GazeYieldCount {
  public:
    /// `rate_hz`: of each eye, by the tracker's word; 0: not known, and nothing counts as missing.
    /// `eyes_measured`: 1 or 2.
    void begin(double rate_hz, int eyes_measured) noexcept;
    /// In the order of an eye's own times.
    void take(const GazeSample& sample) noexcept;
    /// After the recording, which lasted so long by the session's clock.
    GazeYield ended_after(SessionDuration recording) const noexcept;

  private:
    struct OfEye {
        std::optional<TrackerTime> first, last;
    };
    std::array<OfEye, 2> eyes_; ///< by Eye
    double rate_hz_ = 0.0;
    int eyes_measured_ = 1;
    GazeYield yield_;
};

} // namespace overt
