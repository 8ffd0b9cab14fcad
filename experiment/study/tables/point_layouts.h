/// The tables of places that observers pointed at.
#pragma once

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// `results` must outlive these.
RowLayout<AnsweredPointRow> answered_points_layout(const StudyResults& results);
RowLayout<PointSpreadRow> point_spreads_layout(const StudyResults& results);
RowLayout<PointAreaRow> point_areas_layout(const StudyResults& results);
RowLayout<PointPairRow> point_pairs_layout(const StudyResults& results);

} // namespace overt
