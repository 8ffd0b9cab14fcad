/// Settings of gauges put together to reliefs, each held against the surface that was seen.
#pragma once

#include "experiment/statistics/bootstrap.h"
#include "experiment/study/results/relief_rows.h"

namespace overt {

/// Fills points and reliefs, with the regression of attitudes, of the settings, for each picture by observer
/// and, of several, for all together.
///
/// Several settings at a place are taken as the mean of their unit normals. In the camera's perspective the
/// place at (u, v) of the plane at depth 1 lies at depth D, and a surface of the normal N there has
/// d ln D / du = -N_x / (N . (u, v, -1)), the same of v with N_y: ln D is what is put together by least
/// squares over neighbours (point_relief.h), and D has the mean of the true depths, which settings say
/// nothing of. Then z = -D, towards the eye. Means steeper than 85 degrees from the line of sight count
/// as 85.
void reckon_reliefs(StudyReliefs& reliefs, const BootstrapSettings& bootstrap);

/// What of a picture reliefs can differ in, in words: its object, and of the rest what is not the same of
/// all.
std::string picture_in_words(const ReliefOf& of, const std::vector<ReliefRow>& all);

} // namespace overt
