/// Dwell, visits, first arrival and transitions of gaze between areas of the screen.
///
/// A fixation is in an area if its mean place is, and if the area is there halfway through it. Fixations
/// count that began after the onset, are not too short and are of trials that are not excluded, whatever of
/// the object they met.
#pragma once

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Fills in the rows on areas of the screen from the areas of the trials.
void add_screen_area_looks(StudyResults& results, const LevelLists& order, const StudyOptions& options);

} // namespace overt
