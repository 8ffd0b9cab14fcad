/// Where the first fixations of trials go, one by one.
#pragma once

#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// The most fixations from the onset on that are told one by one.
inline constexpr int most_first_fixations = 10;

/// For each area, all trials and each level of each column of the groups: the share of trials whose first,
/// second … counted fixation is on the area, and of all fixations up to that one. Of trials that have so
/// many, on objects with the area; means over each observer's trials, then over observers.
std::vector<FirstFixationsRow> first_fixations(const StudyResults& results, const LevelLists& levels,
                                               const StudyOptions& options);

} // namespace overt
