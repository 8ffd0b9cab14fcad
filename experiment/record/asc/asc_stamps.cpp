#include "experiment/record/asc/asc_stamps.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

namespace overt {

std::int64_t step_of_rounded_stamps_us(std::int64_t us) {
    constexpr int digits = 24; // of single precision, in binary
    const auto ms = static_cast<std::uint64_t>(std::max<std::int64_t>(us / 1000, 1));
    const int bits = static_cast<int>(std::bit_width(ms));
    return bits >= digits ? std::int64_t{1000} << (bits - digits) : 1000 >> std::min(digits - bits, 10);
}

void AscStamps::begin(TrackerTime start) {
    last_.reset();
    repeats_ = 0;
    start_ = start;
}

std::optional<TrackerTime> AscStamps::next_rounded(std::int64_t us, double rate_hz) {
    using Duration = TrackerClock::duration;
    const TrackerTime stamp{Duration(us)};
    const Duration half(step_of_rounded_stamps_us(us) / 2);
    const Duration interval(std::llround(1e6 / rate_hz));
    // The first is at the recording's begin, if its stamp can be that.
    TrackerTime time = stamp;
    if (!last_ && start_ && *start_ >= stamp - half && *start_ <= stamp + half)
        time = *start_;
    // Beyond a gap the stamp is all that there is.
    if (last_ && std::chrono::abs(*last_ + interval - stamp) <= 4 * half + interval)
        time = std::clamp(*last_ + interval, stamp - half, stamp + half);
    if (last_ && time <= *last_)
        return std::nullopt;
    last_ = time;
    return time;
}

std::optional<TrackerTime> AscStamps::next(std::int64_t us, double rate_hz) {
    if (are_rounded_ && rate_hz > 0.0)
        return next_rounded(us, rate_hz);
    const TrackerTime time{TrackerClock::duration(us)};
    if (time != last_) {
        last_ = time;
        repeats_ = 0;
        return time;
    }
    ++repeats_;
    const auto interval_us = static_cast<std::int64_t>(1e6 / (rate_hz > 0.0 ? rate_hz : 2000.0));
    const auto later = TrackerClock::duration(interval_us * repeats_);
    return later < std::chrono::milliseconds(1) ? std::optional(time + later) : std::nullopt;
}

} // namespace overt
