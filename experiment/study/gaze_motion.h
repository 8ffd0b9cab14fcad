/// Is gaze fixed on the object or on the screen while a fixation lasts?
#pragma once

#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Whether the surface under a fixation moved enough on the screen to tell anything.
bool sees_surface_move(const StudyFixation& fixation);

/// Of the squares of the surface's way this share must be left without the tracker's error, or no corrected
/// gain is told.
inline constexpr double least_way_left = 0.25;

/// The gain of gaze along the motion of the surface: of each observer the sum over counted fixations of the
/// products of gaze's way and the surface point's way on the screen (both from their means over the fixation,
/// weighted by duration), divided by that of the squares of the point's way. It is the slope of the line
/// through 0 that tells gaze's way from the surface's. 1: gaze pursues the place it looks at; 0: it stays on
/// the screen, as it would on a highlight that stays while the surface turns beneath it. Noise from sample to
/// sample makes the gain uncertain and not smaller, for it is in gaze alone; the surface point is that of the
/// whole fixation.
///
/// The tracker's constant error changes it: the way is that of a point beside the one that was looked at.
/// `corrected_gain` takes that off by simulation and extrapolation (Cook and Stefanski, J. Am. Stat. Assoc.
/// 89, 1994, 1314-1328): points about the measured one, as far from it as the validation says, have twice the
/// error's variance, and both sums are continued on a line to none of it.
///
/// Rows for all trials and for each level of each column of `--by` but the observer: means over observers.
std::vector<GazeMotionRow> gaze_motions(const StudyResults& results, const LevelLists& levels,
                                        const StudyOptions& options);

} // namespace overt
