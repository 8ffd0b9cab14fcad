/// Figure 4 of the paper, and how it goes on in time.
#pragma once

#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// One row for each group, for each level of each column of the groups, and for all trials. Each observer's
/// fraction counts alike, and the interval is over observers; `pooled` counts fixations alike, as the paper.
/// Fixations on objects without a head are left out.
std::vector<HeadFractionRow> head_fractions(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options);

/// The fraction within stretches of the presentation, for each level of the first column of the groups.
/// Fixations count with their time within the stretch.
std::vector<TimeCourseRow> head_time_course(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options);

} // namespace overt
