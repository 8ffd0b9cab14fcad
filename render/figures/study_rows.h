/// The figures of a study that have a row for each group or pair.
#pragma once

#include <vector>

#include "experiment/study/results/study_results.h"
#include "render/figures/pen.h"

namespace overt {

/// Figure 4, the shares of fixations on the area that was chosen, the head unless another was: levels of one
/// factor each, or groups where there are no such.
std::vector<StudyFigure> area_share_figures(const StudyResults& results);
/// Figure 5, how widely each group looked on each object.
std::vector<StudyFigure> distribution_figures(const StudyResults& results);
/// Table 1, pairs of conditions.
std::vector<StudyFigure> pair_figures(const StudyResults& results);

} // namespace overt
