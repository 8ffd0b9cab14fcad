/// How the observer turns an object: what [[motion]] of the kind "observer" has besides the rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/object_pose.h"
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
/// Where it has elevations, too, each of its turns is a pose at each of them: a turntable that tilts. An
/// elevation is a turn about the horizontal line to the observer's right, which comes after that about the
/// vertical; of positive ones the object is seen more from above.
struct ObserverTurn {
    Degrees step{2.0};
    Degrees from{0.0}, to{360.0};
    Degrees elevation_step{0.0}; ///< 0: it has none, and turns about the vertical alone
    Degrees elevation_from{0.0}, elevation_to{0.0};
    TurnedWith with = TurnedWith::mouse;
    /// Clockwise and counter-clockwise; with elevations also those that take the front up and down.
    std::vector<std::string> keys{"left", "right"};
    double speed_deg_s = 60.0; ///< while a key is held
    double drag_deg = 180.0;   ///< for a drag over the width of the image, in either direction
    TurnStart start = TurnStart::fixed;
    // Of simulated observers, who have keys only: a normal turn by them, a log-normal pause, and again.
    double simulated_turn_deg = 45.0; ///< standard deviation
    double simulated_pause_s = 0.6;   ///< median

    bool is_whole() const { return to.value - from.value >= 360.0 - 1e-9; }
    bool has_elevations() const { return elevation_step.value > 0.0; }
    /// How many turns and elevations there are, and poses, each of these with each of those. Turns run
    /// fastest.
    int turn_count() const;
    int elevation_count() const;
    int pose_count() const { return turn_count() * elevation_count(); }
    /// Of a pose.
    Degrees angle_of(int pose) const { return {from.value + step.value * (pose % turn_count())}; }
    Degrees elevation_of(int pose) const;
    ObjectPose pose_of(int pose) const;
    /// The pose whose angles are nearest; of a whole turn by whole turns, too.
    int nearest(Degrees angle, Degrees elevation = {}) const;
};

/// The elevation of a pose that a turn about the vertical and an elevation make, -180 … 180 degrees.
Degrees elevation_of(const ObjectPose& pose);

/// A pose of a turn about the vertical and an elevation.
ObjectPose turned_and_tilted(Degrees angle, Degrees elevation);

} // namespace overt
