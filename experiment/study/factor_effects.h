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
/// Main effect: main_effect_test() of the trials' numbers, beside what trials have in common that are alike
/// in the other columns and the object, so that a design in which these rotate does not pass for an effect;
/// trials that are alike in these with a single level of the column alone are left out, for they tell nothing
/// of it. Interaction: interaction_test(), beside what either column tells within each object and level of
/// the other columns. `p_holm` is corrected over the rows of the same measure after Holm (1979).
std::vector<FactorEffectRow> factor_effects(const StudyResults& results, const LevelLists& levels,
                                            const StudyOptions& options);

/// The columns that are tested.
std::vector<std::string> tested_columns(const std::vector<std::string>& by);

} // namespace overt
