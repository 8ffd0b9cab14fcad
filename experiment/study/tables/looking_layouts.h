/// Tables of what observers do with their gaze in the course of trials.
#pragma once

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// `results` must outlive the layouts that take them.
RowLayout<MeasureDifferenceRow> measure_differences_layout();
RowLayout<TimeClusterRow> time_clusters_layout();
RowLayout<FirstFixationsRow> first_fixations_layout(const StudyResults& results);
RowLayout<ScanpathRow> scanpaths_layout(const StudyResults& results);
RowLayout<ScanpathLikenessRow> scanpath_likeness_layout(const StudyResults& results);

} // namespace overt
