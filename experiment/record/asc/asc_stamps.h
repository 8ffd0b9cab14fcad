/// The time stamps of samples in an ASC file.
#pragma once

#include <cstdint>
#include <optional>

#include "experiment/session_time.h"

namespace overt {

/// Turns stamps into times, where whole milliseconds may stand twice, as at 2000 Hz: the second is half a
/// millisecond later.
class AscStamps {
  public:
    /// The time of the next sample, whose stamp is `us`; nothing if there was a sample at it already.
    /// `rate_hz` is 0 where it is not known: the only one then at which milliseconds are repeated.
    std::optional<TrackerTime> next(std::int64_t us, double rate_hz);

    /// Since the last begin of a recording.
    std::optional<TrackerTime> last() const { return last_; }

  private:
    std::optional<TrackerTime> last_;
    int repeats_ = 0; ///< of the last
};

} // namespace overt
