/// Tables of how observers turned objects.
#pragma once

#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/results/study_results.h"

namespace overt {

RowLayout<ExplorationRow> exploration_shows_layout(const StudyResults& results);
RowLayout<ExplorationSummaryRow> explorations_layout();

} // namespace overt
