/// Are fixations drawn by light, such as highlights that move over a turning surface?
#pragma once

#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Lightness of what gaze met (LightScores), and how much more it is than at the same place of the screen
/// over the animation and than of the same point of the surface while that is visible: of each observer the
/// mean over counted fixations whose light is known, weighted by duration. Gaze that is spread evenly over
/// the object's picture has a lightness of 0; gaze that does not mind how the light falls at the moment has 0
/// in both differences, whatever places it likes. Gaze on painted spots goes with them: over_place above 0,
/// over_point 0. Gaze on highlights that stay on the screen while the surface turns beneath them: over_point
/// above 0, over_place 0.
///
/// Rows for all trials and for each level of each column of `--by` but the observer: means over observers.
/// None if the light of no fixation is known.
std::vector<LightAtGazeRow> lights_at_gaze(const StudyResults& results, const LevelLists& levels,
                                           const StudyOptions& options);

} // namespace overt
