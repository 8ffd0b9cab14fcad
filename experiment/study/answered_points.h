/// How the places lie that observers pointed at as their answers.
#pragma once

#include "experiment/study/results/study_options.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Fills spreads, areas and pairs from the answers that were read. Places of several observers are compared
/// with PairwiseMean; a share on an area, and the distance of two answers, are means over observers with
/// intervals over them. What is by chance is drawn from the objects' exposure, by the options' seed: of
/// places of the object's pictures that are equally probable for as long as they are shown.
void reckon_points(StudyResults& results, const StudyOptions& options);

} // namespace overt
