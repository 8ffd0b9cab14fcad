/// Refreshes counted by their time stamps alone, while they come in.
#pragma once

#include <cstdint>

#include "experiment/session_time.h"

namespace overt {

/// No display's clock is farther off its nominal rate: 119.88 Hz that is called 120 is off by 0.1 %.
inline constexpr double largest_deviation = 0.003;

/// For displays that say when a picture was taken but not at which refresh. Follows phase and interval of the
/// refreshes, so that the jitter of one stamp is not taken for the next one's, too. A stamp that is off by
/// more than half an interval is miscounted; the count is put right where the next refresh really goes by,
/// and in any case by a RefreshFit afterwards. One thread; allocates nothing.
class RefreshCount {
  public:
    explicit RefreshCount(double nominal_hz)
        : interval_ns_(1e9 / nominal_hz), nominal_ns_(1e9 / nominal_hz) {}

    /// The refresh that began at about this time: more than the one before, from 1. A pause of more than a
    /// second is counted at the interval known by then.
    std::int64_t at(SessionTime stamp) noexcept;

    double interval_ns() const noexcept { return interval_ns_; }

  private:
    double interval_ns_, nominal_ns_;
    SessionTime expected_; ///< of the refresh last counted, smoothed
    std::int64_t count_ = 0;
    std::int64_t owed_ = 0; ///< refreshes counted too many, to be taken back
    int seen_ = 0;
};

} // namespace overt
