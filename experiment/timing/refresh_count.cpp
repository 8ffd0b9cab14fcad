#include "experiment/timing/refresh_count.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

// An alpha-beta filter: it begins by averaging the phase, and settles at a memory of some 16 refreshes.
constexpr double slowest_phase_gain = 0.06;
constexpr double rate_gain = 0.001;
constexpr int refreshes_before_rate = 16;

} // namespace

std::int64_t RefreshCount::at(SessionTime stamp) noexcept {
    if (seen_ == 0) {
        seen_ = 1;
        expected_ = stamp;
        return count_ = 1;
    }
    const double passed_ns = static_cast<double>((stamp - expected_).count());
    const std::int64_t passed = std::max<std::int64_t>(std::llround(passed_ns / interval_ns_), 0);
    // A stamp that was late by more than half an interval was counted one too many.
    const std::int64_t forward = std::max<std::int64_t>(passed - owed_, 1);
    owed_ = std::max<std::int64_t>(forward - (passed - owed_), 0);
    const double error_ns = passed_ns - static_cast<double>(passed) * interval_ns_;
    const bool after_a_pause = passed_ns > 1e9;
    seen_ = after_a_pause ? 1 : seen_ + 1;
    const double phase_gain = std::max(1.0 / seen_, slowest_phase_gain);
    expected_ +=
        SessionDuration(std::llround(static_cast<double>(passed) * interval_ns_ + phase_gain * error_ns));
    if (seen_ > refreshes_before_rate) {
        const double change_ns =
            rate_gain * error_ns / static_cast<double>(std::max<std::int64_t>(passed, 1));
        interval_ns_ = std::clamp(interval_ns_ + change_ns, nominal_ns_ * (1.0 - largest_deviation),
                                  nominal_ns_ * (1.0 + largest_deviation));
    }
    return count_ += forward;
}

} // namespace overt
