/// The figures of a study, fit for a paper.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes each figure that the study has something for into `folder`, made if it is not there, as SVG and
/// PDF: figure_4 (head fractions), figure_5 (distributions), table_1 (pairs), time_course,
/// fixation_durations, main_sequence, data_quality. Gives their names. Throws RecordError.
std::vector<std::string> write_figures(const StudyResults& results, const std::filesystem::path& folder);

} // namespace overt
