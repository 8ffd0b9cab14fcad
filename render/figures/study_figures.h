/// The figures of a study, fit for a paper.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/study/results/study_results.h"
#include "render/figures/pen.h"

namespace overt {

/// Each figure that the study has something for: figure_4 (shares on the chosen area), figure_5
/// (distributions), table_1 (pairs), time_course, fixation_durations, main_sequence, data_quality. Those with
/// a row for each group are in several figures where a page does not hold them: see row_chart.h. They use
/// `results` when they draw.
std::vector<StudyFigure> study_figures(const StudyResults& results);
std::vector<StudyFigure> study_figures(const StudyResults&& results) = delete; // gone before they are drawn

/// Writes them as SVG and PDF into `folder`, made if it is not there. Gives their names. Throws RecordError.
std::vector<std::string> write_figures(const StudyResults& results, const std::filesystem::path& folder);

} // namespace overt
