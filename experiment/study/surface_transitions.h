/// How gaze goes from area to area, beside what the areas' shares alone would give.
#pragma once

#include <string>
#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Of a trial, from one area to another or the same: as the rows below count them.
struct TransitionCount {
    int to = 0;         ///< from the first to the second
    int departures = 0; ///< from the first to any
};
TransitionCount transitions_between(const StudyResults& results, int trial, const std::string& from,
                                    const std::string& to);

/// For all trials, and each level of each column of the groups: one row for each ordered pair of areas,
/// staying included. A transition is from a counted fixation to the next one of the trial; a fixation beside
/// the object between them breaks it. On objects that have both areas. `probability` is that of an observer's
/// transitions from `from` of which the next fixation is on `to`; `chance` the share of `to` among the next
/// fixations of all of the observer's transitions, which is what it would be if where gaze goes did not
/// depend on where it is; each a mean over observers who have any from `from`. A fixation in several areas is
/// in the rows of each.
std::vector<SurfaceTransitionRow> surface_transitions(const StudyResults& results, const LevelLists& order,
                                                      const StudyOptions& options);

} // namespace overt
