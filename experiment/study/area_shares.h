/// Figure 4 of the paper for each area, and how it goes on in time.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Sets StudyResults::areas, those that are compared, and that of figure 4: the first that the options name,
/// else the usual one. Throws InputError, which lists the areas, for a name that no object has.
void name_areas(StudyResults& results, const StudyOptions& options);

/// Whether a fixation is on an area; nothing if it has no part, or its object no such area.
std::optional<bool> is_on_area(const StudyResults& results, const StudyFixation& fixation,
                               std::string_view area);

/// For each area one row for each group, for each level of each column of the groups, and for all trials,
/// with all that AreaRow has. Each observer's share counts alike, and the interval is over observers;
/// `pooled` counts fixations alike, as the paper. Fixations on objects without the area are left out.
std::vector<AreaRow> area_rows(const StudyResults& results, const LevelLists& order,
                               const StudyOptions& options);

/// The shares within stretches of the presentation, for each area and each level of the first column of the
/// groups. Fixations count with their time within the stretch.
std::vector<TimeCourseRow> area_time_course(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options);

/// The rows of figure 4.
std::vector<AreaRow> rows_of_figure_area(const StudyResults& results);

} // namespace overt
