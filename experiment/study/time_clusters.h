/// When two levels of a factor differ in how much of the time goes to an area.
#pragma once

#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Clusters in time (Maris and Oostenveld 2007), for each compared area and each two levels of the compared
/// column. Each observer who has counted fixations in both gives by stretch of `time_step_s` the share of the
/// time of fixation on the area in a less that in b: means over objects and the other columns of `--by`, as
/// far as both levels have fixations then. Where an observer has none the difference is 0, whose sign may be
/// flipped as any other. Stretches beyond the two-sided 5 % quantile of Student's t that follow each other
/// are a cluster; p is by flips of the signs of whole observers and the largest cluster, over the
/// presentation, and over all rows of the table by the same flips.
///
/// A row for each cluster, and one with number 0 where there is none.
std::vector<TimeClusterRow> time_clusters(const StudyResults& results, const LevelLists& levels,
                                          const StudyOptions& options);

/// How many stretches of the presentation the time course has: no more than 120, since the course of a
/// recording that lasts an hour tells nothing.
int stretches_of_time(const StudyResults& results, double time_step_s);
/// Of trials that are not excluded.
double longest_presentation_s(const StudyResults& results);

} // namespace overt
