/// How the observer turns an object: what [[motion]] of the kind "observer" has besides the rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/units.h"

namespace overt {

/// With what an object is turned.
enum class TurnedWith : std::uint8_t {
    mouse, ///< drags, and the wheel
    keys,  ///< that are held
    both
};
template <>
inline constexpr auto names_of<TurnedWith> = enum_names<TurnedWith>("mouse", "keys", "keys-and-mouse");

/// Where the object stands when it comes up.
enum class TurnStart : std::uint8_t {
    fixed, ///< at the motion's angle
    drawn  ///< each pose equally probable, for each trial
};
template <> inline constexpr auto names_of<TurnStart> = enum_names<TurnStart>("fixed", "drawn");

/// The poses from `from` to `to` are `step` apart; angles count from the front view, counter-clockwise seen
/// from above. Of a whole turn the last pose is followed by the first; else it goes no further at the ends.
struct ObserverTurn {
    Degrees step{2.0};
    Degrees from{0.0}, to{360.0};
    TurnedWith with = TurnedWith::mouse;
    std::vector<std::string> keys{"left", "right"}; ///< clockwise and counter-clockwise
    double speed_deg_s = 60.0;                      ///< while a key is held
    double drag_deg = 180.0;                        ///< for a drag over the width of the image
    TurnStart start = TurnStart::fixed;
    // Of simulated observers, who have keys only: a normal turn by them, a log-normal pause, and again.
    double simulated_turn_deg = 45.0; ///< standard deviation
    double simulated_pause_s = 0.6;   ///< median

    bool is_whole() const { return to.value - from.value >= 360.0 - 1e-9; }
    /// How many poses there are, and the angle of one.
    int pose_count() const;
    Degrees angle_of(int pose) const { return {from.value + step.value * pose}; }
    /// The pose whose angle is nearest; of a whole turn by whole turns, too.
    int nearest(Degrees angle) const;
};

} // namespace overt
