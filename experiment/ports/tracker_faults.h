/// What an eye tracker, or the way to it, can do wrong: as a script, for trial runs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

/// One thing that goes wrong in one recording, or with one set-up. Times are the tracker's own, since the
/// recording's first sample.
struct TrackerFault {
    enum class Kind : std::uint8_t {
        stall,       ///< nothing is delivered for `s`; what was measured meanwhile comes late
        gap,         ///< what is measured within `s` is never delivered, and the tracker says so
        garbage,     ///< what is delivered of `s` cannot be read
        doubled,     ///< each sample of `s` is delivered twice
        no_eye,      ///< the eye is not found for `s`
        clock_jump,  ///< the tracker's clock is put forward by `ms`, or back
        slow_start,  ///< the first sample comes `s` late
        unplug,      ///< the way to the tracker is cut; it can be connected after `refusals` attempts
        repeat,      ///< the operator at the tracker's host wants the trial repeated
        skip,        ///< the same: left out
        abort,       ///< the same: the session ended
        calibration, ///< a calibration fails
    };
    Kind kind = Kind::stall;
    std::optional<int> trial = {}; ///< its index; nothing: each
    int attempt = 1;               ///< at the trial, since the program was started
    double at_s = 0.0;             ///< an unplug at 0: the recording does not begin
    double s = 0.0;
    double ms = 0.0;  ///< of clock_jump
    int refusals = 0; ///< of unplug
    int number = 1;   ///< of calibration: which, from 1
    friend bool operator==(const TrackerFault&, const TrackerFault&) = default;
};
template <>
inline constexpr auto names_of<TrackerFault::Kind> =
    enum_names<TrackerFault::Kind>("stall", "gap", "garbage", "doubled", "no-eye", "clock-jump", "slow-start",
                                   "unplug", "repeat", "skip", "abort", "calibration");

struct TrackerFaults {
    std::optional<double> granted_rate_hz; ///< instead of the wished one
    std::vector<TrackerFault> given;

    bool are_none() const { return !granted_rate_hz && given.empty(); }
};

} // namespace overt
