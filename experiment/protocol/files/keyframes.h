/// Tables of places by the time: from a file to how object and light stand in each frame.
#pragma once

#include <string>

#include "experiment/animation.h"
#include "experiment/keys/delimited_text.h"

namespace overt {

/// How long a table goes on: its last time, in seconds; 0 where it cannot be read.
double seconds_of_keyframes(const DelimitedText& table);

/// How object and light stand in each of the motion's frames, frame k at k / frame_rate_hz, after the
/// motion's own turn by `angle`. What is wrong with the table goes to `diagnostics` under `file`, all of it;
/// then nothing is given. The columns: t_s, from 0 on and rising; x, y, z in the unit of the mesh; qw, qx,
/// qy, qz of a rotation of length 1, or angle_deg; light_deg. All but t_s may be missing, and are 0 then.
/// Rotations are turned into one another at one speed on the shortest way (Shoemake 1985, "Animating rotation
/// with quaternion curves"); angles as their numbers say. With `cycle` the last place has to be the first.
std::vector<Pose> poses_of_keyframes(const DelimitedText& table, const Animation& motion,
                                     const std::string& file, Diagnostics& diagnostics);

} // namespace overt
