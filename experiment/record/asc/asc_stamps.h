/// The time stamps of samples in an ASC file.
#pragma once

#include <cstdint>
#include <optional>

#include "experiment/session_time.h"

namespace overt {

/// Turns stamps into times.
///
/// Whole milliseconds may stand twice, as at 2000 Hz: the second is half a millisecond later.
///
/// Stamps with a fraction may be rounded to single precision, as edf2asc -ftime writes them: from 2^24 ms
/// (4.66 h of the tracker's clock) on to whole 2 ms, from 2^25 on to 4, and so on. Where they are, each
/// sample is one interval of the rate after the one before it, as far as its stamp can be the rounding of
/// that.
class AscStamps {
  public:
    explicit AscStamps(bool are_rounded = false) : are_rounded_(are_rounded) {}

    /// A recording begins at `start`, which is not rounded.
    void begin(TrackerTime start);

    /// The time of the next sample, whose stamp is `us`; nothing if there was a sample at it already.
    /// `rate_hz` is 0 where it is not known: the only one then at which milliseconds are repeated.
    std::optional<TrackerTime> next(std::int64_t us, double rate_hz);

    /// Since the last begin of a recording.
    std::optional<TrackerTime> last() const { return last_; }

  private:
    std::optional<TrackerTime> next_rounded(std::int64_t us, double rate_hz);

    bool are_rounded_;
    std::optional<TrackerTime> start_, last_;
    int repeats_ = 0; ///< of the last
};

/// Microseconds between neighbouring numbers of single precision where a stamp lies, as a number of
/// milliseconds.
std::int64_t step_of_rounded_stamps_us(std::int64_t us);

} // namespace overt
