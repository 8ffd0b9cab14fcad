/// A study's mixed models, as a script of R that runs on the exported tables.
#pragma once

#include <filesystem>

#include "experiment/record/tables/table_writer.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes mixed_models.R into the folder of the study's tables: a binomial model of fixations on the area of
/// figure 4, if there is one, and a linear one of the logarithm of WSS, with lme4, by the columns of `--by`
/// that are neither observer nor object. Throws RecordError.
void write_mixed_models(const StudyResults& results, const std::filesystem::path& folder, TableFormat format);

/// Writes answer_models.R into the folder of the study's tables, which reads answer_trials: models of
/// choices, ratings and response times, with lme4 and ordinal where R has them. Throws RecordError.
void write_answer_models(const std::filesystem::path& folder, TableFormat format);

} // namespace overt
