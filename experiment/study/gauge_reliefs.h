/// Settings of gauges put together to reliefs, each held against the surface that was seen.
#pragma once

#include "experiment/study/results/relief_rows.h"

namespace overt {

/// Fills points and reliefs of the settings, for each picture by observer and, of several, for all together.
///
/// Several settings at a place are taken as the mean of their unit normals. In the camera's perspective the
/// place at (u, v) of the plane at depth 1 lies at depth D, and a surface of the normal N there has
/// d ln D / du = -N_x / (N . (u, v, -1)), the same of v with N_y: ln D is what is put together by least
/// squares over neighbours (point_relief.h), and D has the mean of the true depths, which settings say
/// nothing of. Then z = -D, towards the eye. Means steeper than 85 degrees from the line of sight count
/// as 85.
void reckon_reliefs(StudyReliefs& reliefs);

} // namespace overt
