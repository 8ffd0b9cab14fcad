/// The tables of what was set with gauges.
#pragma once

#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// `results` must outlive it.
RowLayout<GaugeSettingRow> gauge_settings_layout(const StudyResults& results);
RowLayout<ReliefPointRow> relief_points_layout();
RowLayout<ReliefRow> reliefs_layout();

} // namespace overt
