/// Whether factors have effects on where and how widely observers look: tests by permutation within
/// observers.
#pragma once

#include <string>
#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// Rows for the share of fixations on each of the compared areas and for the logarithm of WSS of trials: each
/// column of `--by` that is neither the observer nor the object, and each pair of them (interaction).
///
/// Main effect: from each trial's number the mean over all trials that are alike in the other columns and the
/// object is taken off, so that a design in which these rotate does not pass for an effect; trials that
/// are alike in these with a single level of the column alone are left out, for they tell nothing of it. Then
/// level_exchange_test() over observers' means by level. Interaction: the additive part of both columns,
/// within each object and level of the other columns, is taken off (alternating projections), then
/// interaction_flip_test() over observers' means by both. `p_holm` is corrected over the rows of the same
/// measure after Holm (1979).
std::vector<FactorEffectRow> factor_effects(const StudyResults& results, const LevelLists& levels,
                                            const StudyOptions& options);

/// The columns that are tested.
std::vector<std::string> tested_columns(const std::vector<std::string>& by);

} // namespace overt
