/// A number that a study estimates, how far it can be trusted, and why where there is none.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace overt {

/// From low to high, both of them in it.
struct Interval {
    double low = 0.0, high = 0.0;
    bool contains(double value) const { return value >= low && value <= high; }
    friend bool operator==(const Interval&, const Interval&) = default;
};

/// Where a number can be: anywhere; durations, counts and distances; shares.
inline constexpr Interval any_number{-std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::infinity()};
inline constexpr Interval from_zero_on{0.0, std::numeric_limits<double>::infinity()};
inline constexpr Interval zero_to_one{0.0, 1.0};

/// Never holds what is no finite number. Without a value, `absent` says why in a few words that fit into a
/// table's note ("no fixation was counted", "one observer only"); an interval can be absent by itself.
struct Estimate {
    std::optional<double> value;
    std::optional<Interval> interval; ///< of confidence, at the level that the study's parameters name
    std::string absent;

    static Estimate of(double number, std::optional<Interval> interval = {}) {
        return {number, interval, {}};
    }
    static Estimate none(std::string reason) { return {{}, {}, std::move(reason)}; }
    /// With its interval cut off where the quantity cannot be, which makes it no less often right: a share
    /// lies from 0 to 1, a duration is not below 0.
    Estimate cut_to(Interval range) const {
        Estimate cut = *this;
        if (cut.interval)
            cut.interval = Interval{std::clamp(interval->low, range.low, range.high),
                                    std::clamp(interval->high, range.low, range.high)};
        return cut;
    }
};

} // namespace overt
