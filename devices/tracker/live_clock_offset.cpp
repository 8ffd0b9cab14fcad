#include "devices/tracker/live_clock_offset.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace overt {
namespace {

/// Two quartz clocks of computers: twice what their makers allow each.
constexpr double most_drift = 200e-6;

double ns_of(SessionTime time) { return static_cast<double>(time.time_since_epoch().count()); }
double ns_of(TrackerTime time) {
    return static_cast<double>(std::chrono::nanoseconds(time.time_since_epoch()).count());
}

} // namespace

void LiveClockOffset::take(const ClockPair& pair) noexcept {
    const double low_ns = ns_of(pair.before) - ns_of(pair.other),
                 high_ns = ns_of(pair.after) - ns_of(pair.other);
    const double drift_ns = most_drift * std::abs(ns_of(pair.after) - ns_of(taken_));
    taken_ = pair.after;
    const double low = std::max(low_ns_ - drift_ns, low_ns), high = std::min(high_ns_ + drift_ns, high_ns);
    // What contradicts all before is a clock that was set.
    const bool goes_on = is_known_ && low <= high;
    low_ns_ = goes_on ? low : low_ns;
    high_ns_ = goes_on ? high : high_ns;
    is_known_ = true;
}

std::optional<SessionTime> LiveClockOffset::session_time_of(TrackerTime time) const noexcept {
    if (!is_known_)
        return std::nullopt;
    return SessionTime(std::chrono::nanoseconds(std::llround(ns_of(time) + 0.5 * (low_ns_ + high_ns_))));
}

} // namespace overt
