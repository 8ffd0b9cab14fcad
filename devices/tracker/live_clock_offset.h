/// From a tracker's clock to the session's while it records, by the readings of both so far: for what is sent
/// on at once. What is recorded goes by ClockMap, which knows the readings that come later as well.
#pragma once

#include <optional>

#include "experiment/clock_pair.h"
#include "experiment/session_time.h"

namespace overt {

/// Each reading bounds the offset; what all of them allow is kept, and grows by as much as the two clocks may
/// have drifted since. Allocates and throws nothing.
class LiveClockOffset {
  public:
    void take(const ClockPair& pair) noexcept;

    /// When it was in session time, by the middle of what is possible; nothing before the first reading.
    std::optional<SessionTime> session_time_of(TrackerTime time) const noexcept;

  private:
    /// Of session time less tracker time, in ns.
    double low_ns_ = 0.0, high_ns_ = 0.0;
    SessionTime taken_;
    bool is_known_ = false;
};

} // namespace overt
