/// The tables of a study's named areas, column by column.
#pragma once

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"

namespace overt {

// `results` must outlive the layouts.
RowLayout<AreaRow> figure4_layout(const StudyResults& results);
RowLayout<AreaRow> areas_layout(const StudyResults& results);
RowLayout<SurfaceTransitionRow> surface_transitions_layout(const StudyResults& results);
RowLayout<AreaPairRow> area_pairs_layout(const StudyResults& results);

} // namespace overt
