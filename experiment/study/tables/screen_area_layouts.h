/// The tables on areas of the screen.
#pragma once

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"

namespace overt {

// `results` must outlive the layouts.
RowLayout<ScreenAreaTrialRow> screen_area_trials_layout(const StudyResults& results);
RowLayout<AreaTransitionRow> area_transitions_layout(const StudyResults& results);
RowLayout<ScreenAreaRow> screen_areas_layout(const StudyResults& results);

} // namespace overt
